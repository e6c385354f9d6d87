// Rectangles and discs as shapes with points on them.
#pragma once

#include <cstdint>

#include "common/lights/light.h"

namespace relight {

// Maps [0,1)^2 to the unit disc, uniform in area, without a seam at the centre (Shirley and Chiu, "A Low
// Distortion Map Between Disk and Square", JGT 1997).
glm::vec2 square_to_disc(const glm::vec2& u);

// Point i of n of the Hammersley set in (0,1)^2, each in the middle of its stratum: of any n = 2^m points one
// lies in every elementary interval of area 1/n; n = 1 is the centre. The same for each call.
glm::vec2 stratified_point(uint32_t i, uint32_t n);

// A rectangle or disc: centre + x u + y v, with x and y in [-1,1] or on the unit disc.
struct AreaShape {
  glm::vec3 centre, normal;  // unit; where it shines
  glm::vec3 u, v;            // half edges of the rectangle, or two radii of the disc
  float area;
  bool is_disc;
  // lift: how far the centre is moved along the normal.
  AreaShape(const Light& light, float lift);
  // Uniform on the shape for u uniform in [0,1)^2.
  glm::vec3 point(const glm::vec2& square) const;
};

}  // namespace relight
