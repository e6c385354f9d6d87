#include "reference/path_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relight {

namespace {

// Bounces before Russian roulette: short paths carry most of the light and are never cut.
constexpr int bounces_before_roulette = 4;

// Dimensions (pairs) of the random numbers: three a vertex of the eye path.
enum VertexDimension : uint64_t { direction = 0, lobe_and_light = 1, roulette = 2, per_vertex = 3 };

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

PathSampler::PathSampler(const RayTracer& tracer, const LightSampler& lights, const LightPaths& paths,
                         Estimator estimator)
    : tracer_(tracer),
      lights_(lights),
      paths_(paths),
      connector_(tracer, lights, paths),
      use_light_vertex_(estimator == Estimator::light_vertex && paths.max_bounces >= 1 && lights.emits()),
      sampled_sources_(paths.emission || (paths.environment && !tracer.scene().environment.black())) {}

// Strategy "brdf": light reflected by y (found from `distance` away with density `density`) from one light,
// with the weight of the balance heuristic against `connections` light vertices for each such sample.
glm::vec3 PathSampler::from_light(const EyeVertex& y, size_t light, float distance, float density,
                                  float connections, int64_t& rays) const {
  const SurfaceSample& s = *y.surface;
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
      directional_pdf(area_pdf, distance * distance, std::max(0.0f, glm::dot(s.geometric_normal, y.wo)));
  // As a quotient of 1: for a surface seen edge on, `other` may be infinite and the weight is 0.
  return value * (1.0f / (1.0f + connections * other / density));
}

glm::vec3 PathSampler::next_event(const EyeVertex& y, float distance, float density, float connections,
                                  float u, int64_t& rays) const {
  if (!lights_.all()) {
    const size_t light = lights_.choose(u);
    const float probability = lights_.next_event_probability(light);
    return from_light(y, light, distance, density * probability, connections, rays) / probability;
  }
  glm::vec3 sum(0.0f);
  for (size_t light = 0; light < lights_.size(); ++light)
    sum += from_light(y, light, distance, density, connections, rays);
  return sum;
}

glm::vec3 PathSampler::sample(const EyeVertex& x1, const LightVertex& light, const PathRandom& random,
                              int64_t& rays) const {
  const int last = paths_.max_bounces + (sampled_sources_ ? 1 : 0);
  glm::vec3 sum(0.0f), throughput(1.0f);
  SurfaceSample current;
  EyeVertex x = x1;
  // Step k goes from vertex x_k to x_(k+1); point lights reach the eye from there with k bounces, emitters
  // with k - 1.
  for (int k = 1; k <= last; ++k) {
    const bool counts = k >= paths_.min_bounces && k <= paths_.max_bounces;
    const bool emitter_counts = k - 1 >= paths_.min_bounces;
    if (k > 1 && counts && light.surface.valid) sum += throughput * connector_.connect(x, light, 1.0f, rays);

    const uint64_t dimension = static_cast<uint64_t>(k) * per_vertex;
    if (k > bounces_before_roulette) {
      const float survival = std::min(1.0f, std::max({throughput.x, throughput.y, throughput.z}));
      if (!(random.pair(dimension + roulette).x < survival)) break;
      throughput /= survival;
    }
    const bool needs_choice = !black(x.brdf.glossy) || !lights_.all();
    const glm::vec2 choice = needs_choice ? random.pair(dimension + lobe_and_light) : glm::vec2(0.0f);
    const BrdfSample bounce = sample_brdf(x.brdf, x.surface->shading_normal, x.wo, choice.x,
                                          random.pair(dimension + direction), false);
    if (!(bounce.pdf > 0.0f)) break;
    throughput *= x.reflect(bounce.wi) / bounce.pdf;
    if (black(throughput)) break;
    const glm::vec3 origin = tracer_.offset_point(x.surface->position, x.surface->geometric_normal);
    if (!finite(origin) || !finite(bounce.wi)) return glm::vec3(std::numeric_limits<float>::quiet_NaN());
    ++rays;
    const Hit hit = tracer_.intersect(origin, bounce.wi);
    if (!hit.valid) {
      if (paths_.environment && emitter_counts)
        sum += throughput * tracer_.scene().environment.lookup(bounce.wi);
      break;
    }
    current = tracer_.surface(hit, bounce.wi);
    x = {&current, allowed_brdf(current, paths_, false), -bounce.wi};
    if (paths_.emission && emitter_counts) sum += throughput * current.emission;
    const float connections = k == 1 ? static_cast<float>(connections_at_eye) / x1.paths : 1.0f;
    if (counts) sum += throughput * next_event(x, hit.t, bounce.pdf, connections, choice.y, rays);
  }
  return sum;
}

}  // namespace relight
