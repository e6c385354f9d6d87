#include "reference/light_connection.h"

#include <cmath>

namespace relight {

namespace {

enum Dimension : uint64_t { emission_direction = 0, emission_light = 1 };

}  // namespace

// Where `ray` has hit a surface.
LightVertex LightConnector::vertex(const LightRay& ray, const Hit& hit) const {
  LightVertex vertex;
  const SurfaceSample surface = tracer_.surface(hit, ray.direction);
  vertex.irradiance = lights_.emitter(ray.light).irradiance(surface.position, surface.shading_normal,
                                                            surface.geometric_normal);
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

void LightConnector::trace(PathRandom random, std::span<LightVertex> vertices, int64_t& rays) const {
  constexpr size_t at_once = 16;
  for (; vertices.size() > at_once; random.index += at_once, vertices = vertices.subspan(at_once))
    trace(random, vertices.first(at_once), rays);
  LightRay ray[at_once];
  Hit hit[at_once];
  for (size_t i = 0; i < vertices.size(); ++i, ++random.index) {
    const float u_light = lights_.size() > 1 ? random.pair(emission_light).x : 0.0f;
    ray[i] = lights_.emit(u_light, random.pair(emission_direction));
    if (!(ray[i].directional_pdf > 0.0f)) continue;
    ++rays;
    hit[i] = tracer_.intersect(ray[i].origin, ray[i].direction);
  }
  for (size_t i = 0; i < vertices.size(); ++i) tracer_.prefetch_surface(hit[i]);
  for (size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = hit[i].valid ? vertex(ray[i], hit[i]) : LightVertex{};
}

// Radiance along x - y - light for the 16 vertices x of a tile; valid where the bit in `facing` is set.
struct LightConnector::Connections {
  alignas(64) float r[16], g[16], b[16];
  uint32_t facing = 0;  // bit i: x and y see each other's front
  uint32_t active = 0;  // bit i: and light is left
};

// The common case of unshadowed(), from the eye by two diffuse vertices: a fraction of its arithmetic, the
// same bits. Without branches, so that it is computed for eight vertices at once; where x and y coincide,
// their direction is NaN and faces nothing.
LightConnector::Connections LightConnector::unshadowed_diffuse(const EyeTile& tile, const LightVertex& y,
                                                               float count) const {
  const glm::vec3 p = y.surface.position, n = y.surface.geometric_normal;
  const glm::vec3 reflected_at_y = shader::brdf_diffuse(y.brdf), irradiance = y.irradiance;
  const float probability = lights_.next_event_probability(y.light), area_pdf = y.area_pdf,
              paths = tile.paths;
  const Points16 &position = tile.position, &ns = tile.shading_normal, &ng = tile.geometric_normal,
                 &diffuse = tile.diffuse;
  Connections c;
  uint32_t facing[16], active[16];
  for (unsigned i = 0; i < 16; ++i) {
    float wx = p.x - position.x[i], wy = p.y - position.y[i], wz = p.z - position.z[i];
    const float squared = wx * wx + wy * wy + wz * wz;
    const float inverse = 1.0f / std::sqrt(squared);
    wx *= inverse, wy *= inverse, wz *= inverse;
    const float cosine_y = -(n.x * wx + n.y * wy + n.z * wz);
    const float cosine_x = ns.x[i] * wx + ns.y[i] * wy + ns.z[i] * wz;
    const float geometric_x = ng.x[i] * wx + ng.y[i] * wy + ng.z[i] * wz;
    const float r = diffuse.x[i] * cosine_x, g = diffuse.y[i] * cosine_x, b = diffuse.z[i] * cosine_x;
    const float brdf = cosine_x * (1.0f / shader::rl_pi) * probability;
    const float weight = 1.0f / (paths * brdf + count * (area_pdf * squared / cosine_y));
    c.r[i] = reflected_at_y.x * (irradiance.x * weight) * r;
    c.g[i] = reflected_at_y.y * (irradiance.y * weight) * g;
    c.b[i] = reflected_at_y.z * (irradiance.z * weight) * b;
    facing[i] = (cosine_y > 0.0f) & (cosine_x > 0.0f) & (geometric_x > 0.0f);
    const bool dark = (r == 0.0f) & (g == 0.0f) & (b == 0.0f);
    const bool none = (c.r[i] == 0.0f) & (c.g[i] == 0.0f) & (c.b[i] == 0.0f);
    active[i] = !dark & !none;
  }
  for (unsigned i = 0; i < 16; ++i) c.facing |= facing[i] << i, c.active |= active[i] << i;
  c.facing &= tile.valid;
  c.active &= c.facing;
  return c;
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

// unshadowed() where all vertices are diffuse; the same bits.
glm::vec3 LightConnector::unshadowed_diffuse(const EyeVertex& x, const glm::vec3& throughput,
                                             const LightVertex& y, float count) const {
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
  return shader::brdf_diffuse(y.brdf) * (y.irradiance * weight) * (reflected * throughput);
}

void LightConnector::connect(const EyeVertex& x, const Throughput& throughput, const LightVertex& y,
                             float count, int bounces, const PathClasses& classes, glm::vec3* sums,
                             int64_t& rays) const {
  const auto visible = [&] {
    ++rays;
    return tracer_.visible(x.surface->position, x.surface->geometric_normal, y.surface.position,
                           y.surface.geometric_normal);
  };
  if (throughput.only_diffuse() && black(x.brdf.glossy) && black(y.brdf.glossy)) {
    const glm::vec3 value = unshadowed_diffuse(x, throughput.diffuse(), y, count);
    if (!black(value) && visible()) classes.add_diffuse(bounces, LightEnd::local, value, sums);
  } else {
    const SplitRadiance value = unshadowed(x, throughput, y, count);
    if (!black(value.sum()) && visible()) classes.add(bounces, LightEnd::local, value, sums);
  }
}

void LightConnector::connect(const EyeTile& tile, const LightVertex& y, float count,
                             const PathClasses& classes, glm::vec3* sums, int64_t& rays) const {
  const Connections diffuse = unshadowed_diffuse(tile, y, count);
  const uint32_t only_diffuse = black(y.brdf.glossy) ? tile.only_diffuse : 0u;
  SplitRadiance values[16];  // of the others
  uint32_t active = diffuse.active & only_diffuse;
  for (uint32_t i = 0; i < 16; ++i) {
    if (!(((diffuse.facing & ~only_diffuse) >> i) & 1u)) continue;
    values[i] = unshadowed(tile.vertex[i], Throughput(), y, count);
    if (!black(values[i].sum())) active |= 1u << i;
  }
  if (active == 0) return;
  rays += __builtin_popcount(active);
  const glm::vec3 end = tracer_.offset_point(y.surface.position, y.surface.geometric_normal);
  const uint32_t free = tracer_.visible16(tile.start, end, active);
  for (uint32_t i = 0; i < 16; ++i) {
    if (!((free >> i) & 1u)) continue;
    glm::vec3* one = sums + i * classes.count();
    if ((only_diffuse >> i) & 1u)
      classes.add_diffuse(1, LightEnd::local, {diffuse.r[i], diffuse.g[i], diffuse.b[i]}, one);
    else
      classes.add(1, LightEnd::local, values[i], one);
  }
}

}  // namespace relight
