#include "reference/light_sampler.h"

#include <algorithm>
#include <cmath>

#include "common/brdf/brdf.h"

namespace relight {

namespace {

constexpr double two_pi = 6.283185307179586;

// Index of the first entry whose cumulative value exceeds u x total, skipping entries of no weight.
template <typename Entries, typename Cumulative>
size_t find(const Entries& entries, float u, Cumulative cumulative) {
  const double target = static_cast<double>(u) * cumulative(entries.back());
  size_t i = 0;
  while (i + 1 < entries.size() && !(cumulative(entries[i]) > target)) ++i;
  return i;
}

}  // namespace

LightSampler::LightSampler(const LightingState& lighting, float scene_diagonal)
    : scene_diagonal_(scene_diagonal) {
  double power = 0.0, shadowed_power = 0.0;
  for (const Light& light : lighting.lights) {
    if (has_area(light.type)) continue;
    require_no_shader(light, "path tracing");
    Entry entry;
    entry.emitter = emitter_of(light);
    if (light.type == LightType::spot)
      entry.one_minus_cosine = 1.0 - static_cast<double>(entry.emitter.params.direction_outer.w);
    if (has_beam(light.type))
      entry.one_minus_cosine = 1.0 - std::cos(glm::radians(static_cast<double>(entry.emitter.cone_degrees)));
    // W, up to a factor: intensity x solid angle (a spot's falloff between the cones doesn't matter here).
    // A directional light's power: what passes through a square of the scene's size.
    const bool directional = is_parallel(light.type);
    const double extent =
        directional ? std::pow(static_cast<double>(scene_diagonal), 2) / two_pi : entry.one_minus_cosine;
    const double weight =
        extent * static_cast<double>(light.intensity.x + light.intensity.y + light.intensity.z);
    if (!(weight > 0.0)) continue;
    entry.cumulative = power += weight;
    entry.emission_cumulative = shadowed_power += light.casts_shadows && !directional ? weight : 0.0;
    entry.emits = light.casts_shadows && !directional;
    entry.probability = static_cast<float>(weight);
    lights_.push_back(entry);
  }
  for (Entry& entry : lights_) {
    if (entry.emits)
      entry.emission_pdf = static_cast<float>(static_cast<double>(entry.probability) / shadowed_power /
                                              (two_pi * entry.one_minus_cosine));
    entry.probability = static_cast<float>(static_cast<double>(entry.probability) / power);
  }
}

size_t LightSampler::choose(float u) const {
  return find(lights_, u, [](const Entry& entry) { return entry.cumulative; });
}

LightRay LightSampler::emit(float u_light, const glm::vec2& u) const {
  if (!emits()) return {};
  LightRay ray;
  ray.light = find(lights_, u_light, [](const Entry& entry) { return entry.emission_cumulative; });
  const Entry& entry = lights_[ray.light];
  // 1 - cos is drawn instead of cos, so that narrow cones keep their precision.
  const double z = static_cast<double>(u.x) * entry.one_minus_cosine;
  const float sine = static_cast<float>(std::sqrt(std::max(0.0, z * (2.0 - z))));
  const float phi = static_cast<float>(two_pi) * u.y;
  const glm::vec3 local(sine * std::cos(phi), sine * std::sin(phi), static_cast<float>(1.0 - z));
  const bool cone = entry.emitter.cone_degrees < 180.0f;
  ray.origin = glm::vec3(entry.emitter.params.position_type);
  ray.direction = cone ? frame_around(glm::vec3(entry.emitter.params.direction_outer)) * local : local;
  ray.directional_pdf = entry.emission_pdf;
  return ray;
}

}  // namespace relight
