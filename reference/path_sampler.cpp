#include "reference/path_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relight {

namespace {

// Up to this many lights each vertex sends a shadow ray to every one; beyond, one light is chosen by power.
constexpr size_t most_lights_for_all = 4;
// Bounces before Russian roulette: short paths carry most of the light and are never cut.
constexpr int bounces_before_roulette = 4;

// Dimensions (pairs) of the random numbers: two for the light vertex, then three a vertex of the eye path.
enum Dimension : uint64_t { emission_direction = 0, emission_light = 1, first_vertex = 2 };
enum VertexDimension : uint64_t { direction = 0, lobe_and_light = 1, roulette = 2, per_vertex = 3 };

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool black(const glm::vec3& c) { return c == glm::vec3(0.0f); }

// Squared distance and unit direction from a to b; direction 0 if they coincide.
struct Segment {
  glm::vec3 direction;
  float squared;
  Segment(const glm::vec3& a, const glm::vec3& b)
      : direction(b - a), squared(glm::dot(direction, direction)) {
    direction = squared > 0.0f ? direction / std::sqrt(squared) : glm::vec3(0.0f);
  }
};

// Density over directions of a point found with `area_pdf`, with `cosine` between its normal and the line to
// it; infinite edge on.
float directional(float area_pdf, float squared_distance, float cosine) {
  return area_pdf * squared_distance / cosine;
}

}  // namespace

struct PathSampler::EyeVertex {
  const SurfaceSample& surface;
  shader::BrdfParams brdf;  // allowed lobes only
  glm::vec3 wo;             // towards the previous vertex

  // f cos for light from w; 0 from behind either normal.
  glm::vec3 reflect(const glm::vec3& w) const {
    const float cosine = glm::dot(surface.shading_normal, w);
    if (!(cosine > 0.0f) || !(glm::dot(surface.geometric_normal, w) > 0.0f)) return glm::vec3(0.0f);
    return shader::brdf_eval(brdf, surface.shading_normal, wo, w) * cosine;
  }
};

struct PathSampler::LightVertex {
  SurfaceSample surface;  // invalid: nothing to connect to
  size_t light = 0;
  glm::vec3 to_light{0.0f}, irradiance{0.0f};
  float area_pdf = 0.0f;  // density of the vertex [1/area]
};

PathSampler::PathSampler(const RayTracer& tracer, const LightSampler& lights, const LightPaths& paths,
                         Estimator estimator)
    : tracer_(tracer),
      lights_(lights),
      paths_(paths),
      use_light_vertex_(estimator == Estimator::light_vertex),
      all_lights_(lights.size() <= most_lights_for_all),
      sampled_sources_(paths.emission || (paths.environment && !tracer.scene().environment.black())) {}

shader::BrdfParams PathSampler::allowed(const SurfaceSample& surface, bool at_eye) const {
  shader::BrdfParams brdf = surface.brdf();
  if (!(at_eye ? paths_.glossy_at_eye : paths_.glossy_interior)) brdf.glossy = glm::vec3(0.0f);
  return brdf;
}

PathSampler::LightVertex PathSampler::light_vertex(const PathRandom& random, int64_t& rays) const {
  LightVertex vertex;
  const float u_light = lights_.size() > 1 ? random.pair(emission_light).x : 0.0f;
  const LightRay ray = lights_.emit(u_light, random.pair(emission_direction));
  if (!(ray.directional_pdf > 0.0f)) return vertex;
  ++rays;
  const Hit hit = tracer_.intersect(ray.origin, ray.direction);
  if (!hit.valid) return vertex;
  SurfaceSample surface = tracer_.surface(hit, ray.direction);
  vertex.irradiance = shader::light_irradiance(lights_.params(ray.light), surface.position,
                                               surface.shading_normal, surface.geometric_normal);
  if (black(vertex.irradiance)) return vertex;
  const Segment segment(surface.position, ray.origin);
  vertex.surface = surface;
  vertex.light = ray.light;
  vertex.to_light = segment.direction;
  vertex.area_pdf =
      ray.directional_pdf * glm::dot(surface.geometric_normal, segment.direction) / segment.squared;
  return vertex;
}

// Strategy "light": the light vertex y seen from x.
glm::vec3 PathSampler::connect(const EyeVertex& x, const LightVertex& y, int64_t& rays) const {
  const Segment segment(x.surface.position, y.surface.position);
  const glm::vec3& w = segment.direction;
  const float cosine_y = -glm::dot(y.surface.geometric_normal, w);
  if (!(cosine_y > 0.0f)) return glm::vec3(0.0f);
  glm::vec3 value = x.reflect(w);
  if (black(value)) return value;
  value *=
      shader::brdf_eval(allowed(y.surface, false), y.surface.shading_normal, -w, y.to_light) * y.irradiance;
  if (black(value)) return value;
  float brdf = brdf_pdf(x.brdf, x.surface.shading_normal, x.wo, w, false);
  if (!all_lights_) brdf *= lights_.probability(y.light);
  ++rays;
  if (!tracer_.visible(x.surface.position, x.surface.geometric_normal, y.surface.position,
                       y.surface.geometric_normal))
    return glm::vec3(0.0f);
  return value / (brdf + directional(y.area_pdf, segment.squared, cosine_y));
}

// Strategy "brdf": light reflected by y (found from `distance` away with density `density`) from one light,
// with the weight of the balance heuristic.
glm::vec3 PathSampler::from_light(const EyeVertex& y, size_t light, float distance, float density,
                                  int64_t& rays) const {
  const SurfaceSample& s = y.surface;
  glm::vec3 value =
      shader::light_irradiance(lights_.params(light), s.position, s.shading_normal, s.geometric_normal);
  if (black(value)) return value;
  const Segment to_light(s.position, lights_.position(light));
  value *= shader::brdf_eval(y.brdf, s.shading_normal, y.wo, to_light.direction);
  if (black(value)) return value;
  if (lights_.casts_shadows(light)) {
    ++rays;
    if (!tracer_.visible_from_point(s.position, s.geometric_normal, lights_.position(light)))
      return glm::vec3(0.0f);
  }
  if (!use_light_vertex_ || !(lights_.emission_pdf(light) > 0.0f)) return value;
  const float area_pdf =
      lights_.emission_pdf(light) * glm::dot(s.geometric_normal, to_light.direction) / to_light.squared;
  const float other =
      directional(area_pdf, distance * distance, std::max(0.0f, glm::dot(s.geometric_normal, y.wo)));
  // As a quotient of 1: near a corner seen edge on, `other` may be infinite and the weight is 0.
  return value * (1.0f / (1.0f + other / density));
}

glm::vec3 PathSampler::next_event(const EyeVertex& y, float distance, float brdf_pdf, float u,
                                  int64_t& rays) const {
  glm::vec3 sum(0.0f);
  if (all_lights_) {
    for (size_t light = 0; light < lights_.size(); ++light)
      sum += from_light(y, light, distance, brdf_pdf, rays);
    return sum;
  }
  const size_t light = lights_.choose(u);
  const float probability = lights_.probability(light);
  return from_light(y, light, distance, brdf_pdf * probability, rays) / probability;
}

glm::vec3 PathSampler::sample(const SurfaceSample& x1, const glm::vec3& eye, const PathRandom& random,
                              int64_t& rays) const {
  const int last = paths_.max_bounces + (sampled_sources_ ? 1 : 0);
  glm::vec3 sum(0.0f), throughput(1.0f);
  SurfaceSample current = x1;
  glm::vec3 wo = Segment(x1.position, eye).direction;
  LightVertex light;
  if (use_light_vertex_ && paths_.max_bounces >= 1 && lights_.size() > 0) light = light_vertex(random, rays);

  // Step k goes from vertex x_k to x_(k+1); point lights reach the eye from there with k bounces, emitters
  // with k - 1.
  for (int k = 1; k <= last; ++k) {
    const EyeVertex x{current, allowed(current, k == 1), wo};
    const bool counts = k >= paths_.min_bounces && k <= paths_.max_bounces;
    const bool emitter_counts = k - 1 >= paths_.min_bounces;
    if (light.surface.valid && counts) sum += throughput * connect(x, light, rays);

    const uint64_t dimension = first_vertex + static_cast<uint64_t>(k) * per_vertex;
    if (k > bounces_before_roulette) {
      const float survival = std::min(1.0f, std::max({throughput.x, throughput.y, throughput.z}));
      if (!(random.pair(dimension + roulette).x < survival)) break;
      throughput /= survival;
    }
    const bool needs_choice = !black(x.brdf.glossy) || !all_lights_;
    const glm::vec2 choice = needs_choice ? random.pair(dimension + lobe_and_light) : glm::vec2(0.0f);
    const BrdfSample bounce =
        sample_brdf(x.brdf, current.shading_normal, wo, choice.x, random.pair(dimension + direction), false);
    if (!(bounce.pdf > 0.0f)) break;
    throughput *= x.reflect(bounce.wi) / bounce.pdf;
    if (black(throughput)) break;
    const glm::vec3 origin = tracer_.offset_point(current.position, current.geometric_normal);
    if (!finite(origin) || !finite(bounce.wi)) return glm::vec3(std::numeric_limits<float>::quiet_NaN());
    ++rays;
    const Hit hit = tracer_.intersect(origin, bounce.wi);
    if (!hit.valid) {
      if (paths_.environment && emitter_counts)
        sum += throughput * tracer_.scene().environment.lookup(bounce.wi);
      break;
    }
    current = tracer_.surface(hit, bounce.wi);
    wo = -bounce.wi;
    if (paths_.emission && emitter_counts) sum += throughput * current.emission;
    if (counts)
      sum +=
          throughput * next_event({current, allowed(current, false), wo}, hit.t, bounce.pdf, choice.y, rays);
  }
  return sum;
}

}  // namespace relight
