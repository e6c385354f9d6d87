// The state of eye paths while PathSampler makes them.
#pragma once

#include "reference/path_sampler.h"

namespace relight {

// Dimensions (pairs) of the random numbers: six a vertex of the eye path.
enum VertexDimension : uint64_t {
  direction = 0,
  lobe_and_light = 1,
  roulette_and_area = 2,
  area_point = 3,
  environment_direction = 4,
  per_vertex = 6
};

// The state of one eye path. Step k = `vertex` goes from x_k to x_(k+1); delta lights reach the eye from
// there with k bounces, emitters with k - 1.
struct PathSampler::Walk {
  EyeVertex x;
  Throughput throughput;  // reaches x; from the BRDF's ray on, what is seen along it
  int vertex = 1;         // x is x_vertex: light that arrives there has bounced vertex - 1 times
  PathRandom random{};
  glm::vec3* sums = nullptr;
  SurfaceSample behind;  // what x points at from the second vertex on
  // Of the step that is being made:
  BrdfSample bounce;
  Hit hit;  // of the bounce's ray
  float u_light = 0.0f;

  glm::vec2 numbers(VertexDimension which) const {
    return random.pair(static_cast<uint64_t>(vertex) * per_vertex + which);
  }
};

// The paths of a tile, which make each part of a step together: their rays of one kind follow each other, so
// that Embree's nodes and the scene's data stay in the cache, and cache misses of one path overlap with
// work on others.
struct PathSampler::Wave {
  Walk walk[16];
  uint32_t alive = 0;  // bit i: walk[i] goes on
  int64_t& rays;

  // Calls go_on(walk) for each path that is alive; it ends if that returns false.
  template <typename Function>
  void for_each(Function go_on) {
    for (uint32_t left = alive; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      if (!go_on(walk[i])) alive &= ~(1u << i);
    }
  }
};

}  // namespace relight
