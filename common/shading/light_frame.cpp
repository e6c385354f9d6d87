#include "common/shading/light_frame.h"

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

int faces_needed(const Light& light) {
  if (light.type == LightType::omni) return 6;
  if (light.outer_degrees <= widest_single_map_degrees) return 1;
  // The face behind the light starts at 180 - atan(sqrt 2) = 125.3 degrees from the axis, in its corners.
  return light.outer_degrees < 125.0f ? 5 : 6;
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

LightFrame light_frame(const Light& light, float reach, int map_size) {
  LightFrame frame;
  frame.position = light.position;
  frame.faces = faces_needed(light);
  frame.axes =
      light.type == LightType::spot ? frame_with_z(glm::normalize(light.direction)) : glm::mat3(1.0f);
  // A margin of one texel keeps the cone's rim away from the map's border.
  if (frame.faces == 1) {
    frame.tan_half =
        std::tan(glm::radians(light.outer_degrees)) * (1.0f + 2.0f / static_cast<float>(map_size));
  }
  frame.near = reach > 0.0f ? reach * 0x1p-20f : 1.0f;
  return frame;
}

}  // namespace relight
