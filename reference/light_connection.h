// Strategy "light" of the light-vertex estimator (see path_sampler.h): vertices traced from the lights,
// connected to vertices of eye paths, one by one or to the 16 visible points of a 4x4 tile of pixels at once.
#pragma once

#include <span>

#include "common/sampling/random.h"
#include "common/tracing/ray_tracer.h"
#include "reference/eye_tile.h"
#include "reference/light_sampler.h"
#include "reference/path_vertex.h"

namespace relight {

// The random numbers of one path: point `index` of one independent Sobol sequence a pair of dimensions.
struct PathRandom {
  uint64_t scramble;
  uint32_t index;
  glm::vec2 pair(uint64_t dimension) const { return sobol_2d(index, hash_combine(scramble, dimension)); }
};

class LightConnector {
 public:
  LightConnector(const RayTracer& tracer, const LightSampler& lights, const LightPaths& paths)
      : tracer_(tracer), lights_(lights), paths_(paths) {}

  // The first surfaces hit by rays from a light, for points random.index and following of the sequence, one
  // for each of `vertices`; invalid where there is none.
  void trace(PathRandom random, std::span<LightVertex> vertices, int64_t& rays) const;

  // Light reaching the eye by x - y - light, where `throughput` reaches x, divided by the sum of densities
  // m p_b + count p_l, where `count` light vertices are connected to x. Added to sums[0, classes.count()) as
  // light of `bounces` bounces.
  void connect(const EyeVertex& x, const Throughput& throughput, const LightVertex& y, float count,
               int bounces, const PathClasses& classes, glm::vec3* sums, int64_t& rays) const;
  // The same for the vertices of a tile, which the eye sees; adds to sums[i * classes.count()].
  void connect(const EyeTile& tile, const LightVertex& y, float count, const PathClasses& classes,
               glm::vec3* sums, int64_t& rays) const;

 private:
  struct Connections;
  LightVertex vertex(const LightRay& ray, const Hit& hit) const;
  Connections unshadowed_diffuse(const EyeTile& tile, const LightVertex& y, float count) const;
  glm::vec3 unshadowed_diffuse(const EyeVertex& x, const glm::vec3& throughput, const LightVertex& y,
                               float count) const;
  SplitRadiance unshadowed(const EyeVertex& x, const Throughput& throughput, const LightVertex& y,
                           float count) const;
  const RayTracer& tracer_;
  const LightSampler& lights_;
  LightPaths paths_;
};

}  // namespace relight
