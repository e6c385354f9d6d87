#include "common/shading/block_bounds.h"

#include <algorithm>
#include <cmath>

namespace relight {
namespace {

// Some 100 roundings: the light model and these tests each make fewer than 20.
constexpr float relative_margin = 1e-5f;

// Rounding of the cosine that the light model compares with its cone: three products of components of unit
// vectors, each of them a few ulps off.
constexpr float cosine_margin = 1e-6f;

float largest_product(float a_low, float a_high, float b_low, float b_high) {
  return std::max({a_low * b_low, a_low * b_high, a_high * b_low, a_high * b_high});
}

}  // namespace

BlockCulling::BlockCulling(const Emitter& light)
    : position_(light.position()),
      axis_(light.axis()),
      directional_(light.is_directional()),
      cone_(light.cone_degrees < 180.0f),
      cos_outer_(static_cast<float>(std::cos(glm::radians(double{light.cone_degrees}))) - cosine_margin),
      sin_outer_(std::sqrt(std::max(0.0f, 1.0f - cos_outer_ * cos_outer_))) {}

bool BlockCulling::may_be_lit(const BlockBounds& bounds) const {
  if (bounds.empty()) return false;
  return !all_face_away(bounds) && !(cone_ && outside_cone(bounds));
}

// Interval arithmetic on dot(normal, light - position), or on dot(normal, -axis).
bool BlockCulling::all_face_away(const BlockBounds& bounds) const {
  const glm::vec3 to_low = directional_ ? -axis_ : position_ - bounds.high,
                  to_high = directional_ ? -axis_ : position_ - bounds.low;
  const glm::vec3 farthest = glm::max(glm::abs(to_low), glm::abs(to_high));
  float largest = 0.0f;
  for (int c = 0; c < 3; ++c)
    largest += largest_product(bounds.normal_low[c], bounds.normal_high[c], to_low[c], to_high[c]);
  return largest < -relative_margin * (farthest.x + farthest.y + farthest.z);
}

// In a plane through the axis, a point at angle phi and distance rho from the apex of a cone of half-angle
// theta lies rho sin(phi - theta) outside the cone's side. That distance changes by no more than the point
// moves, so a ball whose centre is farther outside than its radius has no point in the cone.
bool BlockCulling::outside_cone(const BlockBounds& bounds) const {
  const glm::vec3 centre = 0.5f * bounds.low + 0.5f * bounds.high;
  const float radius = glm::length(glm::max(bounds.high - centre, centre - bounds.low));
  const glm::vec3 v = centre - position_;
  const float along = glm::dot(v, axis_);
  const float across = glm::length(v - axis_ * along);
  const float size = std::abs(along) + across + radius;
  return across * cos_outer_ - along * sin_outer_ > radius + relative_margin * size;
}

}  // namespace relight
