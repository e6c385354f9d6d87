// Light from infinitely far away, in all directions.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

// Radiance arriving from directions that hit nothing [W/(m^2 sr)]. Constant, or a latitude-longitude map
// (y up, u = 0.5 + atan2(x, -z)/(2 pi), v = acos(y)/pi from the top row) turned by rotation_y radians about
// y.
struct Environment {
  glm::vec3 radiance{0.0f};  // constant radiance, or the multiplier of the map
  std::string file;          // empty: constant
  float rotation_y = 0.0f;
  int width = 0, height = 0;
  std::vector<glm::vec3> texels;
  bool black() const { return radiance == glm::vec3(0.0f); }
  // Radiance from unit direction d, bilinear in the map.
  glm::vec3 lookup(const glm::vec3& d) const;
};

}  // namespace relight
