// RGB float images: row-major, row 0 on top, linear radiance [W/(m^2 sr)] unless a name says otherwise.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace relight {

struct Image {
  int width = 0, height = 0;
  std::vector<glm::vec3> pixels;
  Image() = default;
  Image(int w, int h, glm::vec3 fill = glm::vec3(0.0f))
      : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h), fill) {}
  glm::vec3& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  const glm::vec3& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

}  // namespace relight
