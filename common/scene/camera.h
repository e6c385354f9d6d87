// Pinhole camera. Image row 0 is the top row; pixel (0,0) covers [0,1) x [0,1) in pixel coordinates.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace relight {

struct Camera {
  glm::vec3 eye{0, 0, 5};
  glm::vec3 target{0, 0, 0};
  glm::vec3 up{0, 1, 0};
  float fov_y_degrees = 45.0f;  // full vertical field of view

  // Unit direction through pixel coordinates (px, py), e.g. (x + 0.5, y + 0.5) for a pixel centre.
  glm::vec3 direction(float px, float py, int width, int height) const {
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 true_up = glm::cross(right, forward);
    const float half_height = std::tan(glm::radians(fov_y_degrees) * 0.5f);
    const float half_width = half_height * static_cast<float>(width) / static_cast<float>(height);
    const float sx = (2.0f * px / static_cast<float>(width) - 1.0f) * half_width;
    const float sy = (1.0f - 2.0f * py / static_cast<float>(height)) * half_height;
    return glm::normalize(forward + sx * right + sy * true_up);
  }
};

// Of the name of a view.
inline constexpr const char* view_name_characters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

}  // namespace relight
