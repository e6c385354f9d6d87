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

// All points around s see the light if s does, or none.
bool all_alike(const RayTracer& tracer, const SurfaceSample& s, const glm::vec3& light, float unit_texel) {
  const glm::vec3 n = s.geometric_normal, from_light = s.position - light;
  const bool here = tracer.visible_from_point(s.position, n, light);
  const float distance = glm::length(from_light);
  const glm::mat3 frame = frame_around(from_light / distance);
  for (const float texels : {0.5f, 1.0f, 1.5f}) {
    for (int k = 0; k < 8; ++k) {
      const float angle = 0.7853982f * static_cast<float>(k);
      const glm::vec3 across = frame[0] * std::cos(angle) + frame[1] * std::sin(angle);
      const glm::vec3 moved = from_light + across * (texels * unit_texel * distance);
      const float scale = glm::dot(n, from_light) / glm::dot(n, moved);
      if (!(scale > 0.0f && scale < 4.0f)) return false;  // the texel runs off along the surface
      if (tracer.visible_from_point(light + moved * scale, n, light) != here) return false;
    }
  }
  return true;
}

}  // namespace

float texel_at_unit_depth(const Light& light, int map_size) {
  return 2.0f * light_frame(light, 1.0f, 1.0f, map_size).tan_half / static_cast<float>(map_size);
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

}  // namespace relight::test
