// Which lights must be shaded again and which are in a kept sum. "Our system supports multiple lights by
// caching the results of all lights but the one that is currently moving" (Hasan 2006 section 5).
#pragma once

#include <cstdint>
#include <vector>

#include "common/lights/light.h"

namespace relight {

// True if both give the same light everywhere; names don't count.
bool same_light(const Light& a, const Light& b);

// Decides, from lighting to lighting, how to reuse one sum of lights. A light that is the same in two
// consecutive lightings is shaded into the sum, and stays there while every light of the sum is still lit.
// So a light that moves costs one shading a frame, after one frame in which the others are gathered.
// Knows lights only; whoever shades keeps the sum, on the CPU or the GPU. Results differ from shading
// everything afresh by the rounding of float sums in another order.
class LightCache {
 public:
  struct Plan {
    bool from_zero = true;        // the sum starts again, from zero
    std::vector<Light> into_sum;  // shade these onto the sum
    std::vector<Light> on_top;    // shade these onto a copy of the sum; the result is what was asked for
    int64_t cached = 0;           // lights of the lighting that were in the sum already
    // True if there is a sum to start from; else `on_top` holds all lights.
    bool uses_sum() const { return cached > 0 || !into_sum.empty(); }
    int64_t shaded() const { return static_cast<int64_t>(into_sum.size() + on_top.size()); }
  };
  // What to do for this lighting. Lights of zero intensity appear nowhere. Until done() is called the cache
  // counts as empty, so that a failure on the way leaves nothing wrong behind.
  Plan plan(const LightingState& lighting);
  void done();
  void forget() { sum_.clear(), previous_.clear(); }

 private:
  std::vector<Light> sum_;       // the lights in the kept sum
  std::vector<Light> previous_;  // the lights of the last lighting
  std::vector<Light> pending_sum_, pending_previous_;
};

}  // namespace relight
