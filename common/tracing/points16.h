// Sixteen points or vectors by coordinate, as packets of rays and vectorised loops want them.
#pragma once

#include <glm/glm.hpp>

namespace relight {

struct Points16 {
  alignas(64) float x[16] = {}, y[16] = {}, z[16] = {};

  glm::vec3 get(unsigned i) const { return {x[i], y[i], z[i]}; }
  void set(unsigned i, const glm::vec3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
};

}  // namespace relight
