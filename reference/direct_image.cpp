#include "reference/direct_image.h"

#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

namespace relight {

namespace {

struct Shader {
  const RayTracer& tracer;
  const LightSampler& lights;
  const LightPaths& paths;
  const View& view;

  glm::vec3 from_light(const SurfaceSample& sample, const glm::vec3& wo, size_t light, int64_t& rays) const {
    const glm::vec3 irradiance = shader::light_irradiance(lights.params(light), sample.position,
                                                          sample.shading_normal, sample.geometric_normal);
    if (irradiance == glm::vec3(0.0f)) return irradiance;
    const glm::vec3 position = lights.position(light);
    if (lights.casts_shadows(light)) {
      ++rays;
      if (!tracer.visible_from_point(sample.position, sample.geometric_normal, position))
        return glm::vec3(0.0f);
    }
    const glm::vec3 wi = glm::normalize(position - sample.position);
    return irradiance * shader::brdf_eval(sample.brdf(), sample.shading_normal, wo, wi);
  }

  // (sx, sy) is a sub-pixel of the 2w x 2h grid.
  glm::vec3 radiance(const SurfaceSample& sample, int sx, int sy, int64_t& rays) const {
    if (!sample.valid) {
      if (!paths.environment) return glm::vec3(0.0f);
      return tracer.scene().environment.lookup(view.camera.direction(
          static_cast<float>(sx) + 0.5f, static_cast<float>(sy) + 0.5f, 2 * view.width, 2 * view.height));
    }
    glm::vec3 sum = paths.emission ? sample.emission : glm::vec3(0.0f);
    const glm::vec3 wo = glm::normalize(view.camera.eye - sample.position);
    for (size_t light = 0; light < lights.size(); ++light) sum += from_light(sample, wo, light, rays);
    return sum;
  }
};

}  // namespace

DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const LightPaths& paths) {
  const View& view = buffer.view;
  const Shader shader{tracer, lights, paths, view};
  DirectImage result{Image(view.width, view.height)};
  std::atomic<int64_t> all_rays{0}, all_non_finite{0};
  tbb::parallel_for(0, view.height, [&](int y) {
    int64_t rays = 0, non_finite = 0;
    for (int s = 0; s < 4 * view.width; ++s) {
      const int sx = s % (2 * view.width), sy = 2 * y + s / (2 * view.width);
      const size_t index =
          static_cast<size_t>(sy) * static_cast<size_t>(2 * view.width) + static_cast<size_t>(sx);
      const glm::vec3 value = shader.radiance(buffer.direct[index], sx, sy, rays);
      if (std::isfinite(value.x + value.y + value.z)) {
        result.image.at(sx / 2, y) += 0.25f * value;
      } else {
        ++non_finite;
      }
    }
    all_rays += rays;
    all_non_finite += non_finite;
  });
  result.rays = all_rays;
  result.non_finite = all_non_finite;
  return result;
}

}  // namespace relight
