#include "reference/direct_image.h"

#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/sampling/random.h"
#include "reference/path_vertex.h"

namespace relight {

namespace {

// Of random_bits, where shapes have their numbers.
constexpr uint64_t environment_stream = 0x656e7669726f6eull;

// Radiance of one sub-sample by part.
struct Parts {
  Reflected local, local_area, from_environment;
  glm::vec3 area{0.0f}, environment{0.0f};  // seen
  glm::vec3 area_variance{0.0f};            // of the sum of local_area
  glm::vec3 environment_variance{0.0f};     // of the sum of from_environment
  bool finite() const {
    const glm::vec3 sum = local.sum() + local_area.sum() + from_environment.sum() + area + environment;
    return std::isfinite(sum.x + sum.y + sum.z);
  }
};

struct Shader {
  const RayTracer& tracer;
  const LightSampler& lights;
  const Environment& environment;
  const LightPaths& paths;
  const DeepFrameBuffer& buffer;
  const DirectEstimates& estimates;

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
      const AreaPoint point =
          estimates.area->shape_point(shape, sobol_2d(static_cast<uint32_t>(i), scramble));
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
    for (size_t shape = 0; estimates.area && shape < estimates.area->shape_count(); ++shape) {
      Reflected half[2];
      for (uint64_t k = 0; k < 2; ++k)
        half[k] = from_shape(sample, wo, shape, random_bits(estimates.seed, pixel, shape, k),
                             estimates.points / 2, rays);
      add_halves(half, parts.local_area, parts.area_variance);
    }
  }

  static void add_halves(const Reflected half[2], Reflected& sum, glm::vec3& variance) {
    sum.diffuse += 0.5f * (half[0].diffuse + half[1].diffuse);
    sum.glossy += 0.5f * (half[0].glossy + half[1].glossy);
    const glm::vec3 difference = half[0].sum() - half[1].sum();
    variance += 0.25f * difference * difference;
  }

  // f cos L / (density of the map's samples + density of the BRDF's) at one direction, if the sky is seen
  // there.
  Reflected from_direction(const EyeVertex& x, const glm::vec3& wi, int64_t& rays) const {
    const Reflected reflected = x.reflect(wi);
    if (black(reflected.sum())) return {};
    const SurfaceSample& s = *x.surface;
    ++rays;
    if (!tracer.visible_from_point(s.position, s.geometric_normal,
                                   s.position + wi * (2.0f * tracer.scene().bounds.diagonal())))
      return {};
    const float density =
        estimates.environment->pdf(wi) + brdf_pdf(x.brdf, s.shading_normal, x.wo, wi, false);
    return reflected * (environment.lookup(wi) / density);
  }

  // Each point is one direction by the map and one by the BRDF, with the balance heuristic.
  Reflected from_environment(const EyeVertex& x, uint64_t scramble, int points, int64_t& rays) const {
    Reflected mean;
    const SurfaceSample& s = *x.surface;
    const auto add = [&](const Reflected& one) {
      mean.diffuse += one.diffuse * (1.0f / static_cast<float>(points));
      mean.glossy += one.glossy * (1.0f / static_cast<float>(points));
    };
    for (int i = 0; i < points; ++i) {
      const auto u = [&](uint64_t dimension) {
        return sobol_2d(static_cast<uint32_t>(i), hash_combine(scramble, dimension));
      };
      const EnvironmentSample by_map = estimates.environment->sample(u(0));
      if (by_map.pdf > 0.0f) add(from_direction(x, by_map.direction, rays));
      const BrdfSample by_brdf = sample_brdf(x.brdf, s.shading_normal, x.wo, u(2).x, u(1), false);
      if (by_brdf.pdf > 0.0f) add(from_direction(x, by_brdf.wi, rays));
    }
    return mean;
  }

  void add_environment(const SurfaceSample& sample, const glm::vec3& wo, uint64_t pixel, Parts& parts,
                       int64_t& rays) const {
    if (!estimates.environment) return;
    const EyeVertex x{&sample, allowed_brdf(sample, paths, true), wo};
    Reflected half[2];
    for (uint64_t k = 0; k < 2; ++k)
      half[k] = from_environment(x, random_bits(estimates.seed, pixel, environment_stream, k),
                                 estimates.points / 2, rays);
    add_halves(half, parts.from_environment, parts.environment_variance);
  }

  // (sx, sy) is a sub-pixel of the 2w x 2h grid.
  Parts radiance(const SurfaceSample& sample, int sx, int sy, int64_t& rays) const {
    Parts parts;
    if (!sample.valid) {
      const glm::vec3 direction = buffer.eye_direction(sx, sy);
      if (paths.environment && !black(direction)) parts.environment = environment.lookup(direction);
      return parts;
    }
    if (paths.emission) parts.area = sample.emission;
    const glm::vec3 wo = glm::normalize(buffer.view.camera.eye - sample.position);
    for (size_t light = 0; light < lights.size(); ++light) {
      const Reflected r = from_light(sample, wo, light, rays);
      parts.local.diffuse += r.diffuse, parts.local.glossy += r.glossy;
    }
    const uint64_t pixel =
        static_cast<uint64_t>(sy) * static_cast<uint64_t>(2 * buffer.view.width) + static_cast<uint64_t>(sx);
    add_shapes(sample, wo, pixel, parts, rays);
    add_environment(sample, wo, pixel, parts, rays);
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
  for (size_t i = 0; i < environment_diffuse.pixels.size(); ++i)
    sum.pixels[i] += environment_diffuse.pixels[i] + environment_glossy.pixels[i];
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

std::vector<PathClass> DirectImage::environment_classes() {
  return {{.bounces = 0, .end = LightEnd::environment},
          {.bounces = 0, .glossy_at_eye = true, .end = LightEnd::environment}};
}

DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const Environment& environment, const LightPaths& paths,
                         const DirectEstimates& estimates) {
  const View& view = buffer.view;
  const Shader shader{tracer, lights, environment, paths, buffer, estimates};
  const Image empty(view.width, view.height);
  DirectImage result;
  result.local_diffuse = result.local_glossy = result.seen_area = result.seen_environment = empty;
  if (estimates.area) result.area_diffuse = result.area_glossy = result.area_variance = empty;
  if (estimates.environment)
    result.environment_diffuse = result.environment_glossy = result.environment_variance = empty;
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
      if (estimates.area) {
        result.area_diffuse.at(sx / 2, y) += 0.25f * parts.local_area.diffuse;
        result.area_glossy.at(sx / 2, y) += 0.25f * parts.local_area.glossy;
        result.area_variance.at(sx / 2, y) += 0.0625f * parts.area_variance;
      }
      if (estimates.environment) {
        result.environment_diffuse.at(sx / 2, y) += 0.25f * parts.from_environment.diffuse;
        result.environment_glossy.at(sx / 2, y) += 0.25f * parts.from_environment.glossy;
        result.environment_variance.at(sx / 2, y) += 0.0625f * parts.environment_variance;
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
