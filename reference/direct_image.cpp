#include "reference/direct_image.h"

#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "reference/path_vertex.h"

namespace relight {

namespace {

// Radiance of one sub-sample by part.
struct Parts {
  Reflected local;
  glm::vec3 area{0.0f}, environment{0.0f};
  bool finite() const {
    const glm::vec3 sum = local.sum() + area + environment;
    return std::isfinite(sum.x + sum.y + sum.z);
  }
};

struct Shader {
  const RayTracer& tracer;
  const LightSampler& lights;
  const LightPaths& paths;
  const View& view;

  Reflected from_light(const SurfaceSample& sample, const glm::vec3& wo, size_t light, int64_t& rays) const {
    const glm::vec3 irradiance = shader::light_irradiance(lights.params(light), sample.position,
                                                          sample.shading_normal, sample.geometric_normal);
    if (black(irradiance)) return {};
    const glm::vec3 end = lights.shadow_ray_end(light, sample.position);
    if (lights.casts_shadows(light)) {
      ++rays;
      if (!tracer.visible_from_point(sample.position, sample.geometric_normal, end)) return {};
    }
    return split_brdf(sample.brdf(), sample.shading_normal, wo, glm::normalize(end - sample.position)) *
           irradiance;
  }

  // (sx, sy) is a sub-pixel of the 2w x 2h grid.
  Parts radiance(const SurfaceSample& sample, int sx, int sy, int64_t& rays) const {
    Parts parts;
    if (!sample.valid) {
      if (paths.environment)
        parts.environment = tracer.scene().environment.lookup(view.camera.direction(
            static_cast<float>(sx) + 0.5f, static_cast<float>(sy) + 0.5f, 2 * view.width, 2 * view.height));
      return parts;
    }
    if (paths.emission) parts.area = sample.emission;
    const glm::vec3 wo = glm::normalize(view.camera.eye - sample.position);
    for (size_t light = 0; light < lights.size(); ++light) {
      const Reflected r = from_light(sample, wo, light, rays);
      parts.local.diffuse += r.diffuse, parts.local.glossy += r.glossy;
    }
    return parts;
  }
};

}  // namespace

Image DirectImage::total() const {
  Image sum = local_diffuse;
  for (size_t i = 0; i < sum.pixels.size(); ++i)
    sum.pixels[i] += local_glossy.pixels[i] + seen_area.pixels[i] + seen_environment.pixels[i];
  return sum;
}

std::vector<PathClass> DirectImage::classes() {
  return {{.bounces = 0},
          {.bounces = 0, .glossy_at_eye = true},
          {.bounces = -1, .end = LightEnd::area},
          {.bounces = -1, .end = LightEnd::environment}};
}

DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const LightPaths& paths) {
  const View& view = buffer.view;
  const Shader shader{tracer, lights, paths, view};
  const Image empty(view.width, view.height);
  DirectImage result{empty, empty, empty, empty};
  std::atomic<int64_t> all_rays{0}, all_non_finite{0};
  tbb::parallel_for(0, view.height, [&](int y) {
    int64_t rays = 0, non_finite = 0;
    for (int s = 0; s < 4 * view.width; ++s) {
      const int sx = s % (2 * view.width), sy = 2 * y + s / (2 * view.width);
      const size_t index =
          static_cast<size_t>(sy) * static_cast<size_t>(2 * view.width) + static_cast<size_t>(sx);
      const Parts parts = shader.radiance(buffer.direct[index], sx, sy, rays);
      if (!parts.finite()) {
        ++non_finite;
        continue;
      }
      result.local_diffuse.at(sx / 2, y) += 0.25f * parts.local.diffuse;
      result.local_glossy.at(sx / 2, y) += 0.25f * parts.local.glossy;
      result.seen_area.at(sx / 2, y) += 0.25f * parts.area;
      result.seen_environment.at(sx / 2, y) += 0.25f * parts.environment;
    }
    all_rays += rays;
    all_non_finite += non_finite;
  });
  result.rays = all_rays;
  result.non_finite = all_non_finite;
  return result;
}

}  // namespace relight
