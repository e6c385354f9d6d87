#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "common/shading/direct_lighting.h"
#include "common/shading/traced_visibility.h"
#include "common/tracing/ray_tracer.h"

namespace relight {
namespace {

// Radiance that sample s reflects of a light that it sees; the CPU side of reflected() in
// direct_lighting.glsl.
glm::vec3 reflected(const SurfaceSample& s, const glm::vec3& eye, const Emitter& light, Lobes lobes) {
  const glm::vec3 irradiance = light.irradiance(s.position, s.shading_normal, s.geometric_normal);
  if (irradiance == glm::vec3(0.0f)) return irradiance;
  const shader::BrdfParams brdf = s.brdf();
  if (lobes == Lobes::diffuse) return shader::brdf_diffuse(brdf) * irradiance;
  const glm::vec3 wo = glm::normalize(eye - s.position);
  return shader::brdf_eval(brdf, s.shading_normal, wo, light.direction_from(s.position)) * irradiance;
}

void add_emitter(const RayTracer& tracer, const std::vector<SurfaceSample>& samples, const glm::vec3& eye,
                 const Emitter& light, Lobes lobes, std::vector<glm::vec3>& radiance) {
  int64_t rays = 0;
  std::vector<uint32_t> visible;
  if (light.casts_shadows) visible = traced_visibility(tracer, samples, light, rays);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, samples.size(), 1024), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const bool shadowed = light.casts_shadows && !((visible[i / 32] >> (i % 32)) & 1u);
      if (samples[i].valid && !shadowed) radiance[i] += reflected(samples[i], eye, light, lobes);
    }
  });
}

}  // namespace

std::vector<glm::vec3> shade_direct_cpu(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const glm::vec3& eye, const LightingState& lighting, Lobes lobes,
                                        int area_light_samples) {
  std::vector<glm::vec3> radiance(samples.size(), glm::vec3(0.0f));
  for (const Light& light : lighting.lights) {
    if (light.intensity == glm::vec3(0.0f)) continue;
    require_no_shader(light, "direct lighting on the CPU");
    for (const Emitter& emitter : emitters_of(light, area_light_samples, tracer.offset()))
      add_emitter(tracer, samples, eye, emitter, lobes, radiance);
  }
  return radiance;
}

}  // namespace relight
