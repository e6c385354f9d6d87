// One indirect light path sample: the estimator of the reference.
//
// F(w) = f_x(w) cos_x f_y E_l(y) is the light that reaches the eye vertex x from direction w, where y is the
// first surface in that direction and E_l its irradiance from point light l. Two ways of finding y are
// combined with the balance heuristic (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte
// Carlo Rendering", 1995), both densities taken over directions w at x:
//   brdf:  w from x's BRDF, y by a ray, then next-event estimation (density p_b)
//   light: y by a ray from the light, then a connection to x (density p_l = emission pdf cos_l/r^2
//   d^2/cos_y).
// Either contributes F / (p_b + p_l). Near corners p_b bounds it, in a spot's lit patch p_l does.
#pragma once

#include "common/run/light_paths.h"
#include "common/sampling/random.h"
#include "common/tracing/ray_tracer.h"
#include "reference/light_sampler.h"
#include "reference/path_tracer.h"

namespace relight {

// The random numbers of one path: point `index` of one independent Sobol sequence a pair of dimensions.
struct PathRandom {
  uint64_t scramble;
  uint32_t index;
  glm::vec2 pair(uint64_t dimension) const { return sobol_2d(index, hash_combine(scramble, dimension)); }
};

class PathSampler {
 public:
  PathSampler(const RayTracer& tracer, const LightSampler& lights, const LightPaths& paths,
              Estimator estimator);

  // Radiance leaving x1 (valid) towards the eye along paths of the allowed numbers of bounces; one sample.
  // May be non-finite if the scene's data are. Adds the number of rays traced to `rays`.
  glm::vec3 sample(const SurfaceSample& x1, const glm::vec3& eye, const PathRandom& random,
                   int64_t& rays) const;

 private:
  struct EyeVertex;
  struct LightVertex;
  LightVertex light_vertex(const PathRandom& random, int64_t& rays) const;
  glm::vec3 connect(const EyeVertex& x, const LightVertex& y, int64_t& rays) const;
  glm::vec3 next_event(const EyeVertex& y, float distance, float brdf_pdf, float u, int64_t& rays) const;
  glm::vec3 from_light(const EyeVertex& y, size_t light, float distance, float density, int64_t& rays) const;
  shader::BrdfParams allowed(const SurfaceSample& surface, bool at_eye) const;

  const RayTracer& tracer_;
  const LightSampler& lights_;
  LightPaths paths_;
  bool use_light_vertex_;
  bool all_lights_;       // next-event estimation to every light, else to one chosen at random
  bool sampled_sources_;  // environment or emission, found by BRDF rays only
};

}  // namespace relight
