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

glm::vec3 LightConnector::unshadowed(const EyeVertex& x, const LightVertex& y, float count) const {
  const Segment segment(x.surface->position, y.surface.position);
  const glm::vec3& w = segment.direction;
  const float cosine_y = -glm::dot(y.surface.geometric_normal, w);
  if (!(cosine_y > 0.0f)) return glm::vec3(0.0f);
  const glm::vec3 reflected = x.reflect(w);
  if (black(reflected)) return reflected;
  const glm::vec3 value =
      reflected * shader::brdf_eval(y.brdf, y.surface.shading_normal, -w, y.to_light) * y.irradiance;
  const float brdf =
      brdf_pdf(x.brdf, x.surface->shading_normal, x.wo, w, false) * lights_.next_event_probability(y.light);
  return value * (1.0f / (x.paths * brdf + count * directional_pdf(y.area_pdf, segment.squared, cosine_y)));
}

glm::vec3 LightConnector::connect(const EyeVertex& x, const LightVertex& y, float count,
                                  int64_t& rays) const {
  const glm::vec3 value = unshadowed(x, y, count);
  if (black(value)) return value;
  ++rays;
  const bool visible = tracer_.visible(x.surface->position, x.surface->geometric_normal, y.surface.position,
                                       y.surface.geometric_normal);
  return visible ? value : glm::vec3(0.0f);
}

void LightConnector::connect(const EyeTile& tile, const LightVertex& y, float count, glm::vec3* sums,
                             int64_t& rays) const {
  glm::vec3 values[16];
  uint32_t active = 0;
  for (uint32_t i = 0; i < 16; ++i) {
    if (!((tile.valid >> i) & 1u)) continue;
    values[i] = unshadowed(tile.vertex[i], y, count);
    if (!black(values[i])) active |= 1u << i;
  }
  if (active == 0) return;
  rays += __builtin_popcount(active);
  const glm::vec3 end = tracer_.offset_point(y.surface.position, y.surface.geometric_normal);
  const uint32_t free = tracer_.visible16(tile.position, end, active);
  for (uint32_t i = 0; i < 16; ++i)
    if ((free >> i) & 1u) sums[i] += values[i];
}

}  // namespace relight
