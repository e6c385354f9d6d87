#include "reference/path_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relight {

namespace {

// Bounces before Russian roulette: short paths carry most of the light and are never cut.
constexpr int bounces_before_roulette = 4;

// Dimensions (pairs) of the random numbers: six a vertex of the eye path.
enum VertexDimension : uint64_t {
  direction = 0,
  lobe_and_light = 1,
  roulette_and_area = 2,
  area_point = 3,
  environment_direction = 4,
  per_vertex = 6
};

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

// The state of one eye path. Step k = `vertex` goes from x_k to x_(k+1); delta lights reach the eye from
// there with k bounces, emitters with k - 1.
struct PathSampler::Walk {
  EyeVertex x;
  Throughput throughput;  // reaches x; from the BRDF's ray on, what is seen along it
  int vertex = 1;         // x is x_vertex: light that arrives there has bounced vertex - 1 times
  const PathRandom& random;
  glm::vec3* sums;
  int64_t& rays;
  SurfaceSample behind{};  // what x points at from the second vertex on

  glm::vec2 numbers(VertexDimension which) const {
    return random.pair(static_cast<uint64_t>(vertex) * per_vertex + which);
  }
};

PathSampler::PathSampler(const RayTracer& tracer, const LightSampler& lights, const AreaLights& area,
                         const EnvironmentSampler& environment, const PathClasses& classes,
                         const PathTracerSettings& settings)
    : tracer_(tracer),
      lights_(lights),
      area_(area),
      environment_(environment),
      paths_(settings.paths),
      classes_(classes),
      connector_(tracer, lights, settings.paths),
      use_light_vertex_(settings.estimator == Estimator::light_vertex && settings.paths.max_bounces >= 1 &&
                        lights.emits()),
      environment_counts_(settings.paths.environment && !tracer.scene().environment.black()),
      sample_extended_lights_(settings.sample_extended_lights) {}

// Strategy "brdf": light reflected by y (found from `distance` away with density `density`) from one light,
// with the weight of the balance heuristic against `connections` light vertices for each such sample.
Reflected PathSampler::from_light(const EyeVertex& y, size_t light, float distance, float density,
                                  float connections, int64_t& rays) const {
  const SurfaceSample& s = *y.surface;
  const glm::vec3 irradiance =
      shader::light_irradiance(lights_.params(light), s.position, s.shading_normal, s.geometric_normal);
  if (black(irradiance)) return {};
  const glm::vec3 end = lights_.shadow_ray_end(light, s.position);
  const Segment to_light(s.position, end);
  const Reflected value = split_brdf(y.brdf, s.shading_normal, y.wo, to_light.direction) * irradiance;
  if (black(value.sum())) return {};
  if (lights_.casts_shadows(light)) {
    ++rays;
    if (!tracer_.visible_from_point(s.position, s.geometric_normal, end)) return {};
  }
  if (!use_light_vertex_ || !(lights_.emission_pdf(light) > 0.0f)) return value;
  const float area_pdf =
      lights_.emission_pdf(light) * glm::dot(s.geometric_normal, to_light.direction) / to_light.squared;
  const float other =
      directional_pdf(area_pdf, distance * distance, std::max(0.0f, glm::dot(s.geometric_normal, y.wo)));
  // As a quotient of 1: for a surface seen edge on, `other` may be infinite and the weight is 0.
  return value * glm::vec3(1.0f / (1.0f + connections * other / density));
}

Reflected PathSampler::next_event(const EyeVertex& y, float distance, float density, float connections,
                                  float u, int64_t& rays) const {
  if (!lights_.all()) {
    const size_t light = lights_.choose(u);
    const float probability = lights_.next_event_probability(light);
    return from_light(y, light, distance, density * probability, connections, rays) *
           glm::vec3(1.0f / probability);
  }
  Reflected sum;
  for (size_t light = 0; light < lights_.size(); ++light) {
    const Reflected r = from_light(y, light, distance, density, connections, rays);
    sum.diffuse += r.diffuse, sum.glossy += r.glossy;
  }
  return sum;
}

// A point on an emitter; the balance heuristic against the BRDF's ray makes it f cos L / (p_light + p_brdf).
void PathSampler::next_event_to_area(Walk& walk, float u_choice, const glm::vec2& u) const {
  const AreaPoint point = area_.sample(u_choice, u);
  if (!(point.area_pdf > 0.0f)) return;
  const SurfaceSample& s = *walk.x.surface;
  const Segment segment(s.position, point.position);
  const float facing = -glm::dot(point.normal, segment.direction);
  const float cosine = point.on_surface ? std::abs(facing) : facing;
  if (!(cosine > 0.0f)) return;
  const Reflected reflected = walk.x.reflect(segment.direction);
  if (black(reflected.sum())) return;
  const float light = directional_pdf(point.area_pdf, segment.squared, cosine);
  const float brdf = brdf_pdf(walk.x.brdf, s.shading_normal, walk.x.wo, segment.direction, false);
  ++walk.rays;
  const bool visible = point.on_surface
                           ? tracer_.visible(s.position, s.geometric_normal, point.position, point.normal)
                           : tracer_.visible_from_point(s.position, s.geometric_normal, point.position);
  if (visible)
    classes_.add(walk.vertex - 1, LightEnd::area,
                 walk.throughput.reflect(reflected * (point.radiance / (light + brdf))), walk.sums);
}

void PathSampler::next_event_to_environment(Walk& walk, const glm::vec2& u) const {
  const EnvironmentSample sample = environment_.sample(u);
  if (!(sample.pdf > 0.0f)) return;
  const Reflected reflected = walk.x.reflect(sample.direction);
  if (black(reflected.sum())) return;
  const SurfaceSample& s = *walk.x.surface;
  const float brdf = brdf_pdf(walk.x.brdf, s.shading_normal, walk.x.wo, sample.direction, false);
  const glm::vec3 radiance = tracer_.scene().environment.lookup(sample.direction);
  const glm::vec3 far = s.position + sample.direction * (2.0f * tracer_.scene().bounds.diagonal());
  ++walk.rays;
  if (tracer_.visible_from_point(s.position, s.geometric_normal, far))
    classes_.add(walk.vertex - 1, LightEnd::environment,
                 walk.throughput.reflect(reflected * (radiance / (sample.pdf + brdf))), walk.sums);
}

// Rectangles and discs that the BRDF's ray meets on its way; walk.throughput has passed x.
void PathSampler::hit_shapes(Walk& walk, const glm::vec3& origin, const BrdfSample& bounce,
                             float t_far) const {
  area_.for_each_shape_hit(origin, bounce.wi, t_far, [&](const ShapeHit& hit) {
    const float light = sample_extended_lights_
                            ? directional_pdf(hit.area_pdf, hit.distance * hit.distance, hit.cosine)
                            : 0.0f;
    classes_.add(walk.vertex - 1, LightEnd::area,
                 walk.throughput.emitted(hit.radiance * (1.0f / (1.0f + light / bounce.pdf))), walk.sums);
  });
}

void PathSampler::next_event_to_extended(Walk& walk, float u_choice) const {
  if (!sample_extended_lights_ || !bounces_count(walk.vertex - 1)) return;
  if (!area_.empty()) next_event_to_area(walk, u_choice, walk.numbers(area_point));
  if (environment_counts_ && !environment_.empty())
    next_event_to_environment(walk, walk.numbers(environment_direction));
}

// Russian roulette: true if the path goes on.
bool PathSampler::survives(Walk& walk, float u) const {
  const glm::vec3 t = walk.throughput.sum();
  const float survival = std::min(1.0f, std::max({t.x, t.y, t.z}));
  if (!(u < survival)) return false;
  walk.throughput.scale(1.0f / survival);
  return true;
}

// Draws a direction from x's BRDF and takes throughput through x; pdf 0 if the path ends here.
BrdfSample PathSampler::scatter(Walk& walk, float u_lobe) const {
  const EyeVertex& x = walk.x;
  BrdfSample bounce =
      sample_brdf(x.brdf, x.surface->shading_normal, x.wo, u_lobe, walk.numbers(direction), false);
  if (!(bounce.pdf > 0.0f)) return {};
  const Reflected reflected = x.reflect(bounce.wi);
  if (black(reflected.sum())) return {};
  walk.throughput.advance(reflected * glm::vec3(1.0f / bounce.pdf));
  if (black(walk.throughput.sum())) return {};
  return bounce;
}

// Follows the BRDF's ray; adds the light with an extent that it meets before the next surface, or the
// environment.
Hit PathSampler::follow(Walk& walk, const BrdfSample& bounce) const {
  const SurfaceSample& s = *walk.x.surface;
  const glm::vec3 origin = tracer_.offset_point(s.position, s.geometric_normal);
  if (!finite(origin) || !finite(bounce.wi)) {
    walk.sums[0] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    return {};
  }
  ++walk.rays;
  const Hit hit = tracer_.intersect(origin, bounce.wi);
  if (!bounces_count(walk.vertex - 1)) return hit;
  if (area_.has_shapes())
    hit_shapes(walk, origin, bounce, hit.valid ? hit.t : std::numeric_limits<float>::infinity());
  if (!hit.valid && environment_counts_) {
    const float other = sample_extended_lights_ ? environment_.pdf(bounce.wi) / bounce.pdf : 0.0f;
    const glm::vec3 radiance = tracer_.scene().environment.lookup(bounce.wi) / (1.0f + other);
    classes_.add(walk.vertex - 1, LightEnd::environment, walk.throughput.emitted(radiance), walk.sums);
  }
  return hit;
}

// Light emitted by the surface behind, which the BRDF's ray has found.
void PathSampler::hit_emitter(Walk& walk, const Hit& hit, const BrdfSample& bounce) const {
  const float triangle_pdf = area_.triangle_pdf(hit.triangle);
  if (!bounces_count(walk.vertex - 1) || !(triangle_pdf > 0.0f)) return;
  const float cosine = std::abs(glm::dot(walk.behind.geometric_normal, bounce.wi));
  const float other =
      sample_extended_lights_ ? directional_pdf(triangle_pdf, hit.t * hit.t, cosine) / bounce.pdf : 0.0f;
  classes_.add(walk.vertex - 1, LightEnd::area,
               walk.throughput.emitted(walk.behind.emission * (1.0f / (1.0f + other))), walk.sums);
}

// From x to the next vertex; false if the path ends.
bool PathSampler::step(Walk& walk, const LightVertex& light) const {
  const bool counts = bounces_count(walk.vertex), roulette = walk.vertex > bounces_before_roulette;
  if (walk.vertex > 1 && counts && light.surface.valid)
    classes_.add(walk.vertex, LightEnd::local,
                 connector_.connect(walk.x, walk.throughput, light, 1.0f, walk.rays), walk.sums);
  const glm::vec2 shared = roulette || !area_.empty() ? walk.numbers(roulette_and_area) : glm::vec2(0.0f);
  next_event_to_extended(walk, shared.y);
  if (roulette && !survives(walk, shared.x)) return false;

  const bool needs_choice = !black(walk.x.brdf.glossy) || !lights_.all();
  const glm::vec2 choice = needs_choice ? walk.numbers(lobe_and_light) : glm::vec2(0.0f);
  const BrdfSample bounce = scatter(walk, choice.x);
  if (!(bounce.pdf > 0.0f)) return false;
  const Hit hit = follow(walk, bounce);
  if (!hit.valid) return false;

  const float connections = walk.vertex == 1 ? static_cast<float>(connections_at_eye) / walk.x.paths : 1.0f;
  walk.behind = tracer_.surface(hit, bounce.wi);
  hit_emitter(walk, hit, bounce);
  walk.x = {&walk.behind, allowed_brdf(walk.behind, paths_, false), -bounce.wi};
  if (counts) {
    const Reflected reflected = next_event(walk.x, hit.t, bounce.pdf, connections, choice.y, walk.rays);
    classes_.add(walk.vertex, LightEnd::local, walk.throughput.reflect(reflected), walk.sums);
  }
  return true;
}

void PathSampler::sample(const EyeVertex& x1, const LightVertex& light, const PathRandom& random,
                         glm::vec3* sums, int64_t& rays) const {
  const bool extended = environment_counts_ || !area_.empty();
  const int last = paths_.max_bounces + (extended ? 1 : 0);
  Walk walk{x1, {}, 1, random, sums, rays};
  for (; walk.vertex <= last; ++walk.vertex)
    if (!step(walk, light)) return;
}

}  // namespace relight
