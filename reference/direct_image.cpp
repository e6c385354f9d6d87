#include "reference/direct_image.h"

#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/sampling/random.h"
#include "reference/path_vertex.h"

namespace relight {

namespace {

// Radiance of one sub-sample by part.
struct Parts {
  Reflected local, local_area;
  glm::vec3 area{0.0f}, environment{0.0f};
  glm::vec3 area_variance{0.0f};  // of the sum of local_area
  bool finite() const {
    const glm::vec3 sum = local.sum() + local_area.sum() + area + environment;
    return std::isfinite(sum.x + sum.y + sum.z);
  }
};

struct Shader {
  const RayTracer& tracer;
  const LightSampler& lights;
  const Environment& environment;
  const LightPaths& paths;
  const View& view;
  const AreaLights* area;
  int area_samples;
  uint64_t seed;

  Reflected from_light(const SurfaceSample& sample, const glm::vec3& wo, size_t light, int64_t& rays) const {
    const glm::vec3 irradiance =
        lights.emitter(light).irradiance(sample.position, sample.shading_normal, sample.geometric_normal);
    if (black(irradiance)) return {};
    const glm::vec3 end = lights.shadow_ray_end(light, sample.position);
    if (lights.casts_shadows(light)) {
      ++rays;
      if (!tracer.visible_from_point(sample.position, sample.geometric_normal, end)) return {};
    }
    return split_brdf(sample.brdf(), sample.shading_normal, wo, glm::normalize(end - sample.position)) *
           irradiance;
  }

  // Mean over `points` points of one scrambled sequence on a rectangle or disc.
  Reflected from_shape(const SurfaceSample& sample, const glm::vec3& wo, size_t shape, uint64_t scramble,
                       int points, int64_t& rays) const {
    Reflected mean;
    for (int i = 0; i < points; ++i) {
      const AreaPoint point = area->shape_point(shape, sobol_2d(static_cast<uint32_t>(i), scramble));
      const Segment segment(sample.position, point.position);
      const float facing = -glm::dot(point.normal, segment.direction);
      const float cosine = glm::dot(sample.shading_normal, segment.direction);
      if (!(facing > 0.0f && cosine > 0.0f && glm::dot(sample.geometric_normal, segment.direction) > 0.0f))
        continue;
      ++rays;
      if (!tracer.visible_from_point(sample.position, sample.geometric_normal, point.position)) continue;
      const float weight = cosine * facing / (segment.squared * point.area_pdf * static_cast<float>(points));
      const Reflected one =
          split_brdf(sample.brdf(), sample.shading_normal, wo, segment.direction) * (point.radiance * weight);
      mean.diffuse += one.diffuse, mean.glossy += one.glossy;
    }
    return mean;
  }

  // Two independent halves of the points give the mean and an estimate of its variance.
  void add_shapes(const SurfaceSample& sample, const glm::vec3& wo, uint64_t pixel, Parts& parts,
                  int64_t& rays) const {
    for (size_t shape = 0; area && shape < area->shape_count(); ++shape) {
      Reflected half[2];
      for (uint64_t k = 0; k < 2; ++k)
        half[k] = from_shape(sample, wo, shape, random_bits(seed, pixel, shape, k), area_samples / 2, rays);
      parts.local_area.diffuse += 0.5f * (half[0].diffuse + half[1].diffuse);
      parts.local_area.glossy += 0.5f * (half[0].glossy + half[1].glossy);
      const glm::vec3 difference = half[0].sum() - half[1].sum();
      parts.area_variance += 0.25f * difference * difference;
    }
  }

  // (sx, sy) is a sub-pixel of the 2w x 2h grid.
  Parts radiance(const SurfaceSample& sample, int sx, int sy, int64_t& rays) const {
    Parts parts;
    if (!sample.valid) {
      if (paths.environment)
        parts.environment = environment.lookup(view.camera.direction(
            static_cast<float>(sx) + 0.5f, static_cast<float>(sy) + 0.5f, 2 * view.width, 2 * view.height));
      return parts;
    }
    if (paths.emission) parts.area = sample.emission;
    const glm::vec3 wo = glm::normalize(view.camera.eye - sample.position);
    for (size_t light = 0; light < lights.size(); ++light) {
      const Reflected r = from_light(sample, wo, light, rays);
      parts.local.diffuse += r.diffuse, parts.local.glossy += r.glossy;
    }
    add_shapes(sample, wo, static_cast<uint64_t>(sy) * static_cast<uint64_t>(2 * view.width) + uint64_t(sx),
               parts, rays);
    return parts;
  }
};

}  // namespace

Image DirectImage::total() const {
  Image sum = local_diffuse;
  for (size_t i = 0; i < sum.pixels.size(); ++i)
    sum.pixels[i] += local_glossy.pixels[i] + seen_area.pixels[i] + seen_environment.pixels[i];
  for (size_t i = 0; i < area_diffuse.pixels.size(); ++i)
    sum.pixels[i] += area_diffuse.pixels[i] + area_glossy.pixels[i];
  return sum;
}

std::vector<PathClass> DirectImage::classes() {
  return {{.bounces = 0},
          {.bounces = 0, .glossy_at_eye = true},
          {.bounces = -1, .end = LightEnd::area},
          {.bounces = -1, .end = LightEnd::environment}};
}

std::vector<PathClass> DirectImage::area_classes() {
  return {{.bounces = 0, .end = LightEnd::area},
          {.bounces = 0, .glossy_at_eye = true, .end = LightEnd::area}};
}

DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const Environment& environment, const LightPaths& paths, const AreaLights* area,
                         int area_samples, uint64_t seed) {
  const View& view = buffer.view;
  const Shader shader{tracer, lights, environment, paths, view, area, area_samples, seed};
  const Image empty(view.width, view.height);
  DirectImage result{empty, empty, empty, empty, {}, {}, {}};
  if (area) result.area_diffuse = result.area_glossy = result.area_variance = empty;
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
      if (!area) continue;
      result.area_diffuse.at(sx / 2, y) += 0.25f * parts.local_area.diffuse;
      result.area_glossy.at(sx / 2, y) += 0.25f * parts.local_area.glossy;
      result.area_variance.at(sx / 2, y) += 0.0625f * parts.area_variance;
    }
    all_rays += rays;
    all_non_finite += non_finite;
  });
  result.rays = all_rays;
  result.non_finite = all_non_finite;
  return result;
}

}  // namespace relight
