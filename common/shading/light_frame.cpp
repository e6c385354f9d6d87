#include "common/shading/light_frame.h"

#include <algorithm>
#include <cmath>

namespace relight {
namespace {

// Any orthonormal frame with z = n; n unit. The axis farthest from n keeps the cross product away from zero.
glm::mat3 frame_with_z(const glm::vec3& n) {
  const glm::vec3 a = glm::abs(n);
  const glm::vec3 other = a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0)
                          : a.y <= a.z             ? glm::vec3(0, 1, 0)
                                                   : glm::vec3(0, 0, 1);
  const glm::vec3 x = glm::normalize(glm::cross(other, n));
  return {x, glm::cross(n, x), n};
}

int faces_needed(const Emitter& light) {
  if (light.cone_degrees <= widest_single_map_degrees) return 1;
  // The face behind the light starts at 180 - atan(sqrt 2) = 125.3 degrees from the axis, in its corners.
  return light.cone_degrees < 125.0f ? 5 : 6;
}

// Half-extents of the box along three axes.
glm::vec3 half_extents(const glm::mat3& axes, const Bounds& bounds) {
  const glm::vec3 half = 0.5f * bounds.hi - 0.5f * bounds.lo;
  glm::vec3 extents;
  for (int i = 0; i < 3; ++i) extents[i] = glm::dot(glm::abs(axes[i]), half);
  return extents;
}

}  // namespace

ShadowFace LightFrame::face(int i) const {
  const glm::vec3 x = axes[0], y = axes[1], z = axes[2];
  switch (i) {
    case 0:
      return {x, y, z};
    case 1:
      return {y, z, x};
    case 2:
      return {y, z, -x};
    case 3:
      return {z, x, y};
    case 4:
      return {z, x, -y};
    default:
      return {x, y, -z};
  }
}

LightFrame light_frame(const Emitter& light, float reach, int map_size) {
  LightFrame frame;
  frame.position = light.position();
  frame.faces = faces_needed(light);
  frame.axes = light.cone_degrees < 180.0f ? frame_with_z(light.axis()) : glm::mat3(1.0f);
  // A margin of one texel keeps the cone's rim away from the map's border.
  if (frame.faces == 1) {
    frame.tan_half =
        std::tan(glm::radians(light.cone_degrees)) * (1.0f + 2.0f / static_cast<float>(map_size));
  }
  frame.near = reach > 0.0f ? reach * 0x1p-20f : 1.0f;
  return frame;
}

LightFrame parallel_frame(const Emitter& light, const Bounds& bounds, int map_size) {
  LightFrame frame;
  frame.parallel = true;
  frame.faces = 1;
  frame.axes = frame_with_z(light.axis());
  const bool empty = bounds.lo.x > bounds.hi.x;
  frame.position = empty ? glm::vec3(0.0f) : 0.5f * bounds.lo + 0.5f * bounds.hi;
  const glm::vec3 half = empty ? glm::vec3(0.0f) : half_extents(frame.axes, bounds);
  // A margin of one texel on each side, and of a hundredth in depth; a flat scene still has a volume.
  const float width = std::max({half.x, half.y, 1e-3f * half.z}), depth = std::max(half.z, 1e-3f * width);
  frame.tan_half = width > 0.0f ? width * (1.0f + 2.0f / static_cast<float>(map_size)) : 1.0f;
  frame.near = depth > 0.0f ? 1.01f * depth : 1.0f;
  return frame;
}

}  // namespace relight
