// Bounds of a few neighbouring samples, and the test whether a light can reach any of them. It only ever says
// "no" where the light model gives zero for every sample within the bounds, rounding included.
#pragma once

#include <limits>

#include <glm/glm.hpp>

#include "common/lights/emitter.h"

namespace relight {

// Box of positions and box of geometric normals; empty (low > high) without samples.
struct BlockBounds {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};
  glm::vec3 normal_low{std::numeric_limits<float>::infinity()};
  glm::vec3 normal_high{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& position, const glm::vec3& normal) {
    low = glm::min(low, position), high = glm::max(high, position);
    normal_low = glm::min(normal_low, normal), normal_high = glm::max(normal_high, normal);
  }
  bool empty() const { return !(low.x <= high.x); }
};

// Tests blocks against one light.
class BlockCulling {
 public:
  explicit BlockCulling(const Emitter& light);
  // False only if the light's irradiance is zero for all samples within the bounds.
  bool may_be_lit(const BlockBounds& bounds) const;

 private:
  bool all_face_away(const BlockBounds& bounds) const;
  bool outside_cone(const BlockBounds& bounds) const;

  glm::vec3 position_, axis_;
  bool directional_, cone_;
  float cos_outer_, sin_outer_;  // of a slightly wider cone
};

}  // namespace relight
