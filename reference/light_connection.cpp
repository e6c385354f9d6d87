#include "reference/light_connection.h"

namespace relight {

namespace {

enum Dimension : uint64_t { emission_direction = 0, emission_light = 1 };

}  // namespace

LightVertex LightConnector::trace(const PathRandom& random, int64_t& rays) const {
  LightVertex vertex;
  const float u_light = lights_.size() > 1 ? random.pair(emission_light).x : 0.0f;
  const LightRay ray = lights_.emit(u_light, random.pair(emission_direction));
  if (!(ray.directional_pdf > 0.0f)) return vertex;
  ++rays;
  const Hit hit = tracer_.intersect(ray.origin, ray.direction);
  if (!hit.valid) return vertex;
  const SurfaceSample surface = tracer_.surface(hit, ray.direction);
  vertex.irradiance = shader::light_irradiance(lights_.params(ray.light), surface.position,
                                               surface.shading_normal, surface.geometric_normal);
  if (black(vertex.irradiance)) return vertex;
  const Segment segment(surface.position, ray.origin);
  vertex.surface = surface;
  vertex.brdf = allowed_brdf(surface, paths_, false);
  vertex.light = ray.light;
  vertex.to_light = segment.direction;
  vertex.area_pdf =
      ray.directional_pdf * glm::dot(surface.geometric_normal, segment.direction) / segment.squared;
  return vertex;
}

// The common case of unshadowed(), from the eye by two diffuse vertices: a fraction of its arithmetic, the
// same bits.
glm::vec3 LightConnector::unshadowed_diffuse(const EyeVertex& x, const LightVertex& y, float count) const {
  const Segment segment(x.surface->position, y.surface.position);
  const glm::vec3& w = segment.direction;
  const float cosine_y = -glm::dot(y.surface.geometric_normal, w);
  const float cosine_x = glm::dot(x.surface->shading_normal, w);
  if (!(cosine_y > 0.0f) || !(cosine_x > 0.0f) || !(glm::dot(x.surface->geometric_normal, w) > 0.0f))
    return glm::vec3(0.0f);
  const glm::vec3 reflected = shader::brdf_diffuse(x.brdf) * cosine_x;
  if (black(reflected)) return reflected;
  const float brdf = cosine_x * (1.0f / shader::rl_pi) * lights_.next_event_probability(y.light);
  const float weight =
      1.0f / (x.paths * brdf + count * directional_pdf(y.area_pdf, segment.squared, cosine_y));
  return shader::brdf_diffuse(y.brdf) * (y.irradiance * weight) * reflected;
}

SplitRadiance LightConnector::unshadowed(const EyeVertex& x, const Throughput& throughput,
                                         const LightVertex& y, float count) const {
  const Segment segment(x.surface->position, y.surface.position);
  const glm::vec3& w = segment.direction;
  const float cosine_y = -glm::dot(y.surface.geometric_normal, w);
  if (!(cosine_y > 0.0f)) return {};
  const Reflected reflected = x.reflect(w);
  if (black(reflected.sum())) return {};
  const float brdf =
      brdf_pdf(x.brdf, x.surface->shading_normal, x.wo, w, false) * lights_.next_event_probability(y.light);
  const float weight =
      1.0f / (x.paths * brdf + count * directional_pdf(y.area_pdf, segment.squared, cosine_y));
  Throughput at_y = throughput;
  at_y.advance(reflected);
  return at_y.reflect(split_brdf(y.brdf, y.surface.shading_normal, -w, y.to_light) * (y.irradiance * weight));
}

SplitRadiance LightConnector::connect(const EyeVertex& x, const Throughput& throughput, const LightVertex& y,
                                      float count, int64_t& rays) const {
  const SplitRadiance value = unshadowed(x, throughput, y, count);
  if (black(value.sum())) return value;
  ++rays;
  const bool visible = tracer_.visible(x.surface->position, x.surface->geometric_normal, y.surface.position,
                                       y.surface.geometric_normal);
  return visible ? value : SplitRadiance{};
}

void LightConnector::connect(const EyeTile& tile, const LightVertex& y, float count,
                             const PathClasses& classes, glm::vec3* sums, int64_t& rays) const {
  SplitRadiance values[16];
  uint32_t active = 0;
  const bool diffuse_light = black(y.brdf.glossy);
  for (uint32_t i = 0; i < 16; ++i) {
    if (!((tile.valid >> i) & 1u)) continue;
    const EyeVertex& x = tile.vertex[i];
    if (diffuse_light && black(x.brdf.glossy)) {
      values[i].value[0][0] = unshadowed_diffuse(x, y, count);
      if (!black(values[i].value[0][0])) active |= 1u << i;
    } else {
      values[i] = unshadowed(x, Throughput(), y, count);
      if (!black(values[i].sum())) active |= 1u << i;
    }
  }
  if (active == 0) return;
  rays += __builtin_popcount(active);
  const glm::vec3 end = tracer_.offset_point(y.surface.position, y.surface.geometric_normal);
  const uint32_t free = tracer_.visible16(tile.position, end, active);
  for (uint32_t i = 0; i < 16; ++i)
    if ((free >> i) & 1u) classes.add(1, LightEnd::local, values[i], sums + i * classes.count());
}

}  // namespace relight
