#include "methods/direct_to_indirect/training_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/lights/light.h"
#include "common/sampling/random.h"
#include "common/shading/direct_lighting.h"
#include "common/wavelet/haar.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x7241696e1196ull;
constexpr uint32_t attempts_a_light = 8;

// A light on a random segment from a random view sample to what lies in front of it.
std::optional<Light> random_light(const RayTracer& tracer, const DeepFrameBuffer& buffer, uint64_t seed,
                                  uint64_t number) {
  const auto random = [&](uint64_t dimension) { return random_float(seed, stream, number, dimension); };
  const SurfaceSample& from = buffer.indirect[random_bits(seed, stream, number, 0) % buffer.indirect.size()];
  if (!from.valid) return std::nullopt;
  const glm::vec3 direction = sample_cosine(from.geometric_normal, {random(1), random(2)});
  const Hit hit = tracer.intersect(tracer.offset_point(from.position, from.geometric_normal), direction);
  const float length = hit.valid ? hit.t : 0.5f * tracer.scene().bounds.diagonal();
  Light light;
  light.position = from.position + direction * (length * random(3));
  if (number % 4 == 0) return light;
  light.type = LightType::spot;
  const float z = 2.0f * random(4) - 1.0f, phi = 2.0f * std::numbers::pi_v<float> * random(5);
  const float r = std::sqrt(1.0f - z * z);
  light.direction = {r * std::cos(phi), z, r * std::sin(phi)};
  light.outer_degrees = 8.0f + 40.0f * random(6);
  light.inner_degrees = 0.8f * light.outer_degrees;
  return light;
}

// The mean of the channels on each sample times its factor, of root mean square 1 over the cloud; empty if
// the light reaches no sample. Not of mean 1: a light that almost touches a sample would outweigh all others.
std::vector<float> normalised_light(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const GatherCloud& cloud, std::span<const float> column_scale,
                                    const Light& light) {
  LightingState lighting;
  lighting.lights = {light};
  const std::vector<glm::vec3> direct =
      shade_direct_cpu(tracer, cloud.samples, buffer.view.camera.eye, lighting, Lobes::diffuse);
  std::vector<double> values;
  double squares = 0.0;
  for (size_t j = 0; j < direct.size(); ++j) {
    const glm::dvec3 g(direct[j]);
    const double factor = column_scale.empty() ? 1.0 : static_cast<double>(column_scale[j]);
    values.push_back(factor * (g.x + g.y + g.z) / 3.0);
    squares += values.back() * values.back();
  }
  if (!(squares > 0.0)) return {};
  const double scale = std::sqrt(static_cast<double>(values.size()) / squares);
  std::vector<float> out;
  for (const double v : values) out.push_back(static_cast<float>(scale * v));
  return out;
}

}  // namespace

TrainingLights make_training_lights(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const GatherCloud& cloud, std::span<const float> column_scale,
                                    uint32_t count, uint64_t seed) {
  TrainingLights training;
  if (buffer.indirect.empty()) return training;
  const size_t n = cloud.samples.size();
  training.response.resize(n * count);
  for (uint64_t number = 0; training.count < count && number < uint64_t{attempts_a_light} * count; ++number) {
    const std::optional<Light> light = random_light(tracer, buffer, seed, number);
    if (!light) continue;
    const std::vector<float> values = normalised_light(tracer, buffer, cloud, column_scale, *light);
    if (values.empty()) continue;
    const std::vector<float> coefficients = wavelet::forward(values);
    for (size_t k = 0; k < n; ++k) training.response[k * count + training.count] = coefficients[k];
    ++training.count;
  }
  if (training.count < count)  // closes the gaps; each value moves towards the front
    for (size_t k = 0; k < n; ++k)
      std::copy_n(training.response.begin() + static_cast<std::ptrdiff_t>(k * count), training.count,
                  training.response.begin() + static_cast<std::ptrdiff_t>(k * training.count));
  training.response.resize(n * training.count);
  return training;
}

}  // namespace relight::direct_to_indirect
