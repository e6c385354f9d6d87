// How far two pictures are apart, in double.
#pragma once

#include <cmath>

#include "common/image/image.h"

namespace relight::hard {

inline double norm(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += glm::dot(glm::dvec3(p), glm::dvec3(p));
  return std::sqrt(sum);
}

// |a - b|_2 / |b|_2; 0 if they are equal. NaN if a value is.
inline double relative_difference(const Image& a, const Image& b) {
  double squares = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    squares += glm::dot(d, d);
  }
  return squares == 0.0 ? 0.0 : std::sqrt(squares) / norm(b);
}

}  // namespace relight::hard
