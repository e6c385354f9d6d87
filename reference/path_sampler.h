// Samples of indirect light: the estimators of the reference.
//
// F(w) = f_x(w) cos_x f_y E_l(y) is the light that reaches the eye vertex x from direction w, where y is the
// first surface in that direction and E_l its irradiance from point light l. Two ways of finding y are
// combined with the balance heuristic (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte
// Carlo Rendering", 1995), both densities taken over directions w at x:
//   brdf:  w from x's BRDF, y by a ray, then next-event estimation (m samples, density p_b)
//   light: y by a ray from the light, then a connection to x (n samples, density
//          p_l = emission pdf cos_l/r^2 d^2/cos_y).
// The sum of F / (m p_b + n p_l) over all m + n samples is the estimate. Near corners p_b bounds it, in a
// spot's lit patch p_l does.
//
// Light with an extent (emitting surfaces, rectangles, discs, environment maps) is found from each vertex
// both by a point or direction drawn from the light and by the BRDF's ray, combined in the same way.
#pragma once

#include "reference/area_lights.h"
#include "reference/environment_sampler.h"
#include "reference/light_connection.h"
#include "reference/path_tracer.h"

namespace relight {

class PathSampler {
 public:
  // Light vertices connected to each visible point for each path from it. A connection costs a tenth of a
  // path, as its shadow rays are traced in packets of 16; beyond 16, paths through the BRDF hold most of the
  // noise.
  static constexpr int connections_at_eye = 16;

  PathSampler(const RayTracer& tracer, const LightSampler& lights, const AreaLights& area,
              const EnvironmentSampler& environment, const PathClasses& classes,
              const PathTracerSettings& settings);

  // True if the estimator connects visible points to light vertices.
  bool connects_at_eye() const { return use_light_vertex_ && paths_.min_bounces <= 1; }
  bool uses_light_vertices() const { return use_light_vertex_; }
  const PathClasses& classes() const { return classes_; }
  const LightConnector& connector() const { return connector_; }
  EyeVertex eye_vertex(const SurfaceSample& x1, const glm::vec3& eye) const {
    return {&x1, allowed_brdf(x1, paths_, true), Segment(x1.position, eye).direction};
  }

  // Radiance leaving the visible points of `tile` towards the eye along paths of the allowed numbers of
  // bounces, one sample each, without what the caller gets from connections_at_eye connections to them.
  // `light` (may be invalid) is connected to the vertices behind them. The path of point i has the random
  // numbers {scramble[i], index} and adds to sums[i * classes().count() + ...], which may become non-finite
  // if the scene's data are; the number of rays traced is added to `rays`.
  void sample(const EyeTile& tile, const LightVertex& light, const uint64_t* scramble, uint32_t index,
              glm::vec3* sums, int64_t& rays) const;

 private:
  struct Walk;
  struct Wave;
  Reflected next_event(const EyeVertex& y, float distance, float density, float connections, float u,
                       int64_t& rays) const;
  Reflected from_light(const EyeVertex& y, size_t light, float distance, float density, float connections,
                       int64_t& rays) const;
  void step(Wave& wave, int vertex, const LightVertex& light) const;
  bool scatter(Walk& walk, bool roulette, int64_t& rays) const;
  void arrive(Walk& walk, int64_t& rays) const;
  bool survives(Walk& walk, float u) const;
  bool draw_direction(Walk& walk, float u_lobe) const;
  bool follow(Walk& walk, int64_t& rays) const;
  // Light with an extent; path_sampler_extended.cpp.
  void next_event_to_extended(Walk& walk, float u_choice, int64_t& rays) const;
  void next_event_to_area(Walk& walk, float u_choice, const glm::vec2& u, int64_t& rays) const;
  void next_event_to_environment(Walk& walk, const glm::vec2& u, int64_t& rays) const;
  void hit_emitter(Walk& walk) const;
  void hit_shapes(Walk& walk, const glm::vec3& origin) const;
  void hit_environment(Walk& walk) const;
  bool bounces_count(int bounces) const {
    return bounces >= paths_.min_bounces && bounces <= paths_.max_bounces;
  }

  bool environment_counts(int bounces) const {
    return environment_counts_ && bounces >= paths_.min_bounces &&
           bounces <= paths_.last_environment_bounce();
  }

  const RayTracer& tracer_;
  const LightSampler& lights_;
  const AreaLights& area_;
  const EnvironmentSampler& environment_;
  LightPaths paths_;
  const PathClasses& classes_;
  LightConnector connector_;
  bool use_light_vertex_;
  bool environment_counts_;
  bool sample_extended_lights_;
};

}  // namespace relight
