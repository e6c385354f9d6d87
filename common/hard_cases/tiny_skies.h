// Environment maps for hard cases and tests.
#pragma once

#include <cmath>
#include <random>

#include "common/scene/scene.h"

namespace relight::tiny {

inline Environment black_map(int width, int height, float rotation = 0.0f) {
  Environment map;
  map.radiance = glm::vec3(1.0f);
  map.width = width, map.height = height;
  map.rotation_y = rotation;
  map.texels.assign(static_cast<size_t>(width) * static_cast<size_t>(height), glm::vec3(0.0f));
  return map;
}

// Every texel different, a few black, brightness over three decades.
inline Environment uneven_map(int width, int height, float rotation) {
  Environment map = black_map(width, height, rotation);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> u(0.0f, 1.0f);
  for (glm::vec3& t : map.texels) {
    const float brightness = std::pow(10.0f, 3.0f * u(random) - 2.0f);
    t = u(random) < 0.1f ? glm::vec3(0.0f) : brightness * glm::vec3(u(random), u(random), u(random));
  }
  return map;
}

}  // namespace relight::tiny
