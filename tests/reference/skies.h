// Environment maps for tests, and an independent reading of their convention: u = 1/2 + (atan2(x, -z) +
// rotation) / (2 pi), v = angle from +y / pi, row 0 on top.
#pragma once

#include <cmath>

#include "common/hard_cases/tiny_skies.h"

namespace relight::tiny {

inline Environment one_texel(int width, int height, int column, int row, float rotation,
                             const glm::vec3& radiance = glm::vec3(1.0f)) {
  Environment map = black_map(width, height, rotation);
  map.texels[static_cast<size_t>(row * width + column)] = radiance;
  return map;
}

// Place in the map in texels: columns [0, width), rows [0, height].
inline glm::dvec2 place_in_map(const Environment& map, const glm::dvec3& d) {
  const double u = 0.5 + (std::atan2(d.x, -d.z) + static_cast<double>(map.rotation_y)) / (2.0 * M_PI);
  const double v = std::atan2(std::hypot(d.x, d.z), d.y) / M_PI;
  return {(u - std::floor(u)) * map.width, v * map.height};
}

inline glm::dvec3 direction_at(const Environment& map, const glm::dvec2& place) {
  const double azimuth = 2.0 * M_PI * (place.x / map.width - 0.5) - static_cast<double>(map.rotation_y);
  const double polar = M_PI * place.y / map.height;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// Sum of f(direction) x solid angle over a grid of `fine` x `fine` midpoints in each texel of a block.
template <typename Function>
glm::dvec3 integrate_map(const Environment& map, const glm::ivec2& first, const glm::ivec2& last, int fine,
                         Function f) {
  glm::dvec3 sum(0.0);
  const double step = 1.0 / fine;
  for (int j = first.y * fine; j < (last.y + 1) * fine; ++j) {
    const double band = std::cos(M_PI * j * step / map.height) - std::cos(M_PI * (j + 1) * step / map.height);
    for (int i = first.x * fine; i < (last.x + 1) * fine; ++i)
      sum +=
          f(direction_at(map, {(i + 0.5) * step, (j + 0.5) * step})) * (band * 2.0 * M_PI * step / map.width);
  }
  return sum;
}

}  // namespace relight::tiny
