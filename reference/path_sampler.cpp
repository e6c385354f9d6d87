#include "reference/path_sampler.h"
#include "common/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "reference/path_walk.h"

namespace relight {

namespace {

// Bounces before Russian roulette: short paths carry most of the light and are never cut.
constexpr int bounces_before_roulette = 4;

}  // namespace

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
      environment_counts_(settings.paths.environment && !environment.environment().black()),
      sample_extended_lights_(settings.sample_extended_lights) {}

// Strategy "brdf": light reflected by y (found from `distance` away with density `density`) from one light,
// with the weight of the balance heuristic against `connections` light vertices for each such sample.
Reflected PathSampler::from_light(const EyeVertex& y, size_t light, float distance, float density,
                                  float connections, int64_t& rays) const {
  const SurfaceSample& s = *y.surface;
  const glm::vec3 irradiance =
      lights_.emitter(light).irradiance(s.position, s.shading_normal, s.geometric_normal);
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

// Russian roulette: true if the path goes on.
bool PathSampler::survives(Walk& walk, float u) const {
  const glm::vec3 t = walk.throughput.sum();
  const float survival = std::min(1.0f, std::max({t.x, t.y, t.z}));
  if (!(u < survival)) return false;
  walk.throughput.scale(1.0f / survival);
  return true;
}

// Draws a direction from x's BRDF and takes throughput through x; false if the path ends here.
bool PathSampler::draw_direction(Walk& walk, float u_lobe) const {
  const EyeVertex& x = walk.x;
  walk.bounce = sample_brdf(x.brdf, x.surface->shading_normal, x.wo, u_lobe, walk.numbers(direction), false);
  if (!(walk.bounce.pdf > 0.0f)) return false;
  const Reflected reflected = x.reflect(walk.bounce.wi);
  if (black(reflected.sum())) return false;
  walk.throughput.advance(reflected * glm::vec3(1.0f / walk.bounce.pdf));
  return !black(walk.throughput.sum());
}

// Follows the BRDF's ray; adds the light with an extent that it meets before the next surface, or the
// environment. False if there is no next surface.
bool PathSampler::follow(Walk& walk, int64_t& rays) const {
  const SurfaceSample& s = *walk.x.surface;
  const glm::vec3 origin = tracer_.offset_point(s.position, s.geometric_normal);
  if (!finite(origin) || !finite(walk.bounce.wi)) {
    walk.sums[0] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    return false;
  }
  ++rays;
  walk.hit = tracer_.intersect(origin, walk.bounce.wi);
  if (bounces_count(walk.vertex - 1) && area_.has_shapes()) hit_shapes(walk, origin);
  if (!walk.hit.valid && environment_counts(walk.vertex - 1)) hit_environment(walk);
  return walk.hit.valid;
}

// The first half of a step: leaves x in a direction of its BRDF; false if the path ends.
bool PathSampler::scatter(Walk& walk, bool roulette, int64_t& rays) const {
  const glm::vec2 shared = roulette || !area_.empty() ? walk.numbers(roulette_and_area) : glm::vec2(0.0f);
  next_event_to_extended(walk, shared.y, rays);
  if (roulette && !survives(walk, shared.x)) return false;
  const bool needs_choice = !black(walk.x.brdf.glossy) || !lights_.all();
  const glm::vec2 choice = needs_choice ? walk.numbers(lobe_and_light) : glm::vec2(0.0f);
  walk.u_light = choice.y;
  return draw_direction(walk, choice.x);
}

// The second half of a step: the surface that was hit becomes x.
void PathSampler::arrive(Walk& walk, int64_t& rays) const {
  const float connections = walk.vertex == 1 ? static_cast<float>(connections_at_eye) / walk.x.paths : 1.0f;
  // Made in place, because a copy stalls: see surface().
  new (&walk.behind) SurfaceSample(tracer_.surface(walk.hit, walk.bounce.wi));
  hit_emitter(walk);
  walk.x.move_to(walk.behind, paths_, -walk.bounce.wi);
  if (!bounces_count(walk.vertex)) return;
  const Reflected reflected =
      next_event(walk.x, walk.hit.t, walk.bounce.pdf, connections, walk.u_light, rays);
  if (walk.throughput.only_diffuse() && black(reflected.glossy))
    classes_.add_diffuse(walk.vertex, LightEnd::local, reflected.diffuse * walk.throughput.diffuse(),
                         walk.sums);
  else
    classes_.add(walk.vertex, LightEnd::local, walk.throughput.reflect(reflected), walk.sums);
}

// From x_vertex of all paths that are alive to the next vertex.
void PathSampler::step(Wave& wave, int vertex, const LightVertex& light) const {
  wave.for_each([&](Walk& walk) {
    walk.vertex = vertex;
    return true;
  });
  if (vertex > 1 && bounces_count(vertex) && light.surface.valid)
    wave.for_each([&](Walk& walk) {
      connector_.connect(walk.x, walk.throughput, light, 1.0f, vertex, classes_, walk.sums, wave.rays);
      return true;
    });
  wave.for_each([&](Walk& walk) { return scatter(walk, vertex > bounces_before_roulette, wave.rays); });
  wave.for_each([&](Walk& walk) { return follow(walk, wave.rays); });
  wave.for_each([&](Walk& walk) {
    tracer_.prefetch_surface(walk.hit);
    return true;
  });
  wave.for_each([&](Walk& walk) {
    arrive(walk, wave.rays);
    return true;
  });
}

void PathSampler::sample(const EyeTile& tile, const LightVertex& light, const uint64_t* scramble,
                         uint32_t index, glm::vec3* sums, int64_t& rays) const {
  // Light with an extent is found from the vertex before.
  int last = paths_.max_bounces + (area_.empty() ? 0 : 1);
  if (environment_counts_) last = std::max(last, paths_.last_environment_bounce() + 1);
  Wave wave{{}, tile.valid, rays};
  for (uint32_t i = 0; i < 16; ++i) {
    if (!((tile.valid >> i) & 1u)) continue;
    wave.walk[i].x = tile.vertex[i];
    wave.walk[i].random = {scramble[i], index};
    wave.walk[i].sums = sums + i * classes_.count();
  }
  for (int vertex = 1; vertex <= last && wave.alive != 0; ++vertex) step(wave, vertex, light);
}

}  // namespace relight
