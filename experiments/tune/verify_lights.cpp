#include "experiments/tune/verify_lights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {

namespace {

constexpr uint64_t stream = 0x76657269667931ull;  // "verify1"
constexpr uint64_t tries = 1000;
constexpr size_t most_presets = 4;

class Numbers {
 public:
  Numbers(uint64_t seed, uint64_t number) : seed_(seed), number_(number) {}
  float next() { return random_float(seed_, stream, number_, dimension_++); }

 private:
  uint64_t seed_, number_, dimension_ = 0;
};

std::vector<const SurfaceSample*> visible_samples(const DeepFrameBuffer& buffer) {
  std::vector<const SurfaceSample*> seen;
  for (const SurfaceSample& s : buffer.indirect)
    if (s.valid) seen.push_back(&s);
  if (seen.empty())
    fail("tune: the view shows nothing that a lamp could be hung in front of; give --verify-lights");
  return seen;
}

double median_distance2(const std::vector<const SurfaceSample*>& seen, const glm::vec3& from) {
  std::vector<double> distances;
  for (const SurfaceSample* s : seen) {
    const glm::dvec3 d = glm::dvec3(s->position) - glm::dvec3(from);
    distances.push_back(glm::dot(d, d));
  }
  std::nth_element(distances.begin(), distances.begin() + static_cast<ptrdiff_t>(distances.size() / 2),
                   distances.end());
  return distances[distances.size() / 2];
}

// Sum of what the lamps give at the view's median distance from each; parallel light counts as it is. Grey 1
// for what has no such number (areas).
glm::dvec3 typical_irradiance(const std::vector<const SurfaceSample*>& seen, const LightingState& lighting) {
  glm::dvec3 sum(0.0);
  for (const Light& light : lighting.lights)
    if (!has_area(light.type))
      sum += is_parallel(light.type) ? glm::dvec3(light.intensity)
                                     : glm::dvec3(light.intensity) / median_distance2(seen, light.position);
  return sum == glm::dvec3(0.0) ? glm::dvec3(1.0) : sum;
}

}  // namespace

std::string lamp_file_text(const Scene& scene, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                           const LightingState& like, uint64_t seed, uint64_t number) {
  const auto seen = visible_samples(buffer);
  Numbers random(seed, number);
  const auto pick = [&] {
    return seen[std::min(static_cast<size_t>(random.next() * static_cast<float>(seen.size())),
                         seen.size() - 1)];
  };
  for (uint64_t i = 0; i < tries; ++i) {
    const SurfaceSample& below = *pick();
    const glm::vec3 position =
        below.position + (0.1f + 0.23f * random.next()) * scene.bounds.diagonal() * below.geometric_normal;
    const SurfaceSample& target = *pick();
    if (!tracer.visible_from_point(below.position, below.geometric_normal, position) ||
        !tracer.visible_from_point(target.position, target.geometric_normal, position))
      continue;
    const glm::dvec3 intensity = typical_irradiance(seen, like) * median_distance2(seen, position);
    const auto vector = [](const auto& v) { return fmt::format("[{:.7g}, {:.7g}, {:.7g}]", v.x, v.y, v.z); };
    const bool spot = number % 2 == 1;
    return fmt::format(
        "# A lamp that no search saw (relight tune, seed {}, lamp {}).\n[[light]]\ntype = \"{}\"\n"
        "position = {}\nintensity = {}\n{}",
        seed, number, spot ? "spot" : "omni", vector(position), vector(intensity),
        spot ? fmt::format("target = {}\nouter_degrees = 35\n", vector(target.position)) : "");
  }
  fail("tune: found no free place for lamp {} in front of the view; give --verify-lights", number);
}

std::vector<std::string> choose_verify_lights(const Session& session, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, lighting] : session.scene().lightings)
    if (name != session.lighting_preset() && names.size() < most_presets) names.push_back(name);
  for (uint64_t number = 0; names.size() < wanted_verify_lights; ++number) {
    const std::filesystem::path file = folder / fmt::format("lamp_{}.toml", number + 1);
    write_text_atomically(file, lamp_file_text(session.scene(), session.tracer(), session.buffer(),
                                               session.lighting(), session.options().seed, number));
    names.push_back(file.string());
  }
  return names;
}

}  // namespace relight
