// Is every part of a point or colour a finite number?
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace relight {

inline bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace relight
