#include "tests/shading/shadow_edges.h"

#include <cmath>

#include "common/brdf/brdf.h"
#include "common/shading/light_frame.h"
#include "common/tracing/ray_tracer.h"

namespace relight::test {
namespace {

bool lit_side(const SurfaceSample& s, const shader::LightParams& light) {
  return s.valid &&
         shader::light_irradiance(light, s.position, s.shading_normal, s.geometric_normal) != glm::vec3(0.0f);
}

// All points around s see the light if s does, or none. In double: the points must stay on the plane of s
// even if the light is far away.
bool all_alike(const RayTracer& tracer, const SurfaceSample& s, const glm::vec3& light, float unit_texel) {
  const bool here = tracer.visible_from_point(s.position, s.geometric_normal, light);
  const glm::dvec3 n(s.geometric_normal), from_light = glm::dvec3(s.position) - glm::dvec3(light);
  const double distance = glm::length(from_light);
  const glm::dmat3 frame(frame_around(glm::vec3(from_light / distance)));
  for (const double texels : {0.5, 1.0, 1.5}) {
    for (int k = 0; k < 8; ++k) {
      const double angle = glm::radians(45.0 * k);
      const glm::dvec3 across = frame[0] * std::cos(angle) + frame[1] * std::sin(angle);
      const glm::dvec3 moved = from_light + across * (texels * double{unit_texel} * distance);
      const double scale = glm::dot(n, from_light) / glm::dot(n, moved);
      if (!(scale > 0.0 && scale < 4.0)) return false;  // the texel runs off along the surface
      const glm::vec3 point(glm::dvec3(s.position) + (moved * scale - from_light));
      if (tracer.visible_from_point(point, s.geometric_normal, light) != here) return false;
    }
  }
  return true;
}

}  // namespace

float texel_at_unit_depth(const Light& light, int map_size) {
  return 2.0f * light_frame(emitter_of(light), 1.0f, map_size).tan_half / static_cast<float>(map_size);
}

std::vector<uint8_t> away_from_shadow_edges(const RayTracer& tracer,
                                            const std::vector<SurfaceSample>& samples, const Light& light,
                                            int map_size) {
  const shader::LightParams params = light.params();
  const float texel = texel_at_unit_depth(light, map_size);
  std::vector<uint8_t> away(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    away[i] = !lit_side(samples[i], params) || all_alike(tracer, samples[i], light.position, texel);
  }
  return away;
}

std::vector<uint8_t> away_from_parallel_shadow_edges(const RayTracer& tracer,
                                                     const std::vector<SurfaceSample>& samples,
                                                     const Light& light, float texel) {
  const shader::LightParams params = light.params();
  const glm::dvec3 axis = glm::normalize(glm::dvec3(light.direction));
  const glm::dmat3 frame(frame_around(glm::vec3(axis)));
  const glm::vec3 towards = glm::vec3(axis) * (-2.0f * tracer.scene().bounds.diagonal());
  const auto alike = [&](const SurfaceSample& s) {
    const auto lit = [&](const glm::vec3& p) {
      return tracer.visible_from_point(p, s.geometric_normal, p + towards);
    };
    const glm::dvec3 n(s.geometric_normal);
    const bool here = lit(s.position);
    for (int k = 0; k < 24; ++k) {
      const double angle = glm::radians(45.0 * (k % 8)), radius = 0.5 * (1 + k / 8) * double{texel};
      const glm::dvec3 across = radius * (frame[0] * std::cos(angle) + frame[1] * std::sin(angle));
      const double along = -glm::dot(n, across) / glm::dot(n, axis);
      if (!(std::abs(along) < 4.0 * double{texel})) return false;  // the texel runs off along the surface
      if (lit(glm::vec3(glm::dvec3(s.position) + across + along * axis)) != here) return false;
    }
    return true;
  };
  std::vector<uint8_t> away(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) away[i] = !lit_side(samples[i], params) || alike(samples[i]);
  return away;
}

}  // namespace relight::test
