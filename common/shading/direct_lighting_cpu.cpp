#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "common/run/error.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/traced_visibility.h"

namespace relight {
namespace {

// Radiance that sample s reflects of a light that it sees; the CPU side of reflected() in
// direct_lighting.glsl.
glm::vec3 reflected(const SurfaceSample& s, const glm::vec3& eye, const shader::LightParams& light,
                    Lobes lobes) {
  const glm::vec3 irradiance =
      shader::light_irradiance(light, s.position, s.shading_normal, s.geometric_normal);
  if (irradiance == glm::vec3(0.0f)) return irradiance;
  const shader::BrdfParams brdf = s.brdf();
  if (lobes == Lobes::diffuse) return shader::brdf_diffuse(brdf) * irradiance;
  const glm::vec3 wo = glm::normalize(eye - s.position);
  const glm::vec3 wi = glm::normalize(glm::vec3(light.position_type) - s.position);
  return shader::brdf_eval(brdf, s.shading_normal, wo, wi) * irradiance;
}

}  // namespace

void require_omni_or_spot(const Light& light) {
  if (light.type != LightType::omni && light.type != LightType::spot)
    fail(
        "direct lighting: light '{}' is neither omni nor spot; other lights are in the reference only, so "
        "far",
        light.name);
}

std::vector<glm::vec3> shade_direct_cpu(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const glm::vec3& eye, const LightingState& lighting, Lobes lobes) {
  std::vector<glm::vec3> radiance(samples.size(), glm::vec3(0.0f));
  for (const Light& light : lighting.lights) {
    if (light.intensity == glm::vec3(0.0f)) continue;
    require_omni_or_spot(light);
    const shader::LightParams params = light.params();
    int64_t rays = 0;
    std::vector<uint32_t> visible;
    if (light.casts_shadows) visible = traced_visibility(tracer, samples, light, rays);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, samples.size(), 1024), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) {
        const bool shadowed = light.casts_shadows && !((visible[i / 32] >> (i % 32)) & 1u);
        if (samples[i].valid && !shadowed) radiance[i] += reflected(samples[i], eye, params, lobes);
      }
    });
  }
  return radiance;
}

}  // namespace relight
