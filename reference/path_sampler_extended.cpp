// Light with an extent (emitting surfaces, rectangles, discs, environment maps) in PathSampler: found by
// points drawn from it and by the BRDF's rays, combined with the balance heuristic.
#include <cmath>
#include <limits>

#include "reference/path_walk.h"

namespace relight {

// A point on an emitter; the balance heuristic against the BRDF's ray makes it f cos L / (p_light + p_brdf).
void PathSampler::next_event_to_area(Walk& walk, float u_choice, const glm::vec2& u, int64_t& rays) const {
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
  ++rays;
  const bool visible = point.on_surface
                           ? tracer_.visible(s.position, s.geometric_normal, point.position, point.normal)
                           : tracer_.visible_from_point(s.position, s.geometric_normal, point.position);
  if (visible)
    classes_.add(walk.vertex - 1, LightEnd::area,
                 walk.throughput.reflect(reflected * (point.radiance / (light + brdf))), walk.sums);
}

void PathSampler::next_event_to_environment(Walk& walk, const glm::vec2& u, int64_t& rays) const {
  const EnvironmentSample sample = environment_.sample(u);
  if (!(sample.pdf > 0.0f)) return;
  const Reflected reflected = walk.x.reflect(sample.direction);
  if (black(reflected.sum())) return;
  const SurfaceSample& s = *walk.x.surface;
  const float brdf = brdf_pdf(walk.x.brdf, s.shading_normal, walk.x.wo, sample.direction, false);
  const glm::vec3 radiance = environment_.environment().lookup(sample.direction);
  const glm::vec3 far = s.position + sample.direction * (2.0f * tracer_.scene().bounds.diagonal());
  ++rays;
  if (tracer_.visible_from_point(s.position, s.geometric_normal, far))
    classes_.add(walk.vertex - 1, LightEnd::environment,
                 walk.throughput.reflect(reflected * (radiance / (sample.pdf + brdf))), walk.sums);
}

// Rectangles and discs that the BRDF's ray meets on its way; walk.throughput has passed x.
void PathSampler::hit_shapes(Walk& walk, const glm::vec3& origin) const {
  const BrdfSample& bounce = walk.bounce;
  const float t_far = walk.hit.valid ? walk.hit.t : std::numeric_limits<float>::infinity();
  area_.for_each_shape_hit(origin, bounce.wi, t_far, [&](const ShapeHit& hit) {
    const float light = sample_extended_lights_
                            ? directional_pdf(hit.area_pdf, hit.distance * hit.distance, hit.cosine)
                            : 0.0f;
    classes_.add(walk.vertex - 1, LightEnd::area,
                 walk.throughput.emitted(hit.radiance * (1.0f / (1.0f + light / bounce.pdf))), walk.sums);
  });
}

void PathSampler::next_event_to_extended(Walk& walk, float u_choice, int64_t& rays) const {
  if (!sample_extended_lights_) return;
  if (!area_.empty() && bounces_count(walk.vertex - 1))
    next_event_to_area(walk, u_choice, walk.numbers(area_point), rays);
  if (!environment_.empty() && environment_counts(walk.vertex - 1))
    next_event_to_environment(walk, walk.numbers(environment_direction), rays);
}

// Light emitted by the surface behind, which the BRDF's ray has found.
void PathSampler::hit_emitter(Walk& walk) const {
  const Hit& hit = walk.hit;
  const BrdfSample& bounce = walk.bounce;
  const float triangle_pdf = area_.triangle_pdf(hit.triangle);
  if (!bounces_count(walk.vertex - 1) || !(triangle_pdf > 0.0f)) return;
  const float cosine = std::abs(glm::dot(walk.behind.geometric_normal, bounce.wi));
  const float other =
      sample_extended_lights_ ? directional_pdf(triangle_pdf, hit.t * hit.t, cosine) / bounce.pdf : 0.0f;
  classes_.add(walk.vertex - 1, LightEnd::area,
               walk.throughput.emitted(walk.behind.emission * (1.0f / (1.0f + other))), walk.sums);
}

// The environment, which the BRDF's ray sees.
void PathSampler::hit_environment(Walk& walk) const {
  const BrdfSample& bounce = walk.bounce;
  const float other = sample_extended_lights_ ? environment_.pdf(bounce.wi) / bounce.pdf : 0.0f;
  const glm::vec3 radiance = environment_.environment().lookup(bounce.wi) / (1.0f + other);
  classes_.add(walk.vertex - 1, LightEnd::environment, walk.throughput.emitted(radiance), walk.sums);
}

}  // namespace relight
