// Points of the six-dimensional space in which samples are clustered: position and normal, scaled so that
// their squared distances add up (clustered gather paper, 2006, section 3.3.2).
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace relight::clustered_gather {

// Two of the eight coordinates stay zero, so that a point is one vector register.
struct alignas(32) Point6 {
  std::array<float, 8> x{};
};

inline float distance2(const Point6& a, const Point6& b) {
  float sum = 0.0f;
  for (size_t k = 0; k < 6; ++k) sum += (a.x[k] - b.x[k]) * (a.x[k] - b.x[k]);
  return sum;
}

// The paper asks that "two samples with completely different normals are about as distant as two samples
// across the scene": opposite normals, 2 apart, count as the diagonal times `normal_weight`.
class Metric6 {
 public:
  Metric6(float scene_diagonal, float normal_weight) : normal_scale_(0.5f * scene_diagonal * normal_weight) {}
  Point6 operator()(const glm::vec3& position, const glm::vec3& normal) const {
    const glm::vec3 n = normal * normal_scale_;
    return {{position.x, position.y, position.z, n.x, n.y, n.z, 0.0f, 0.0f}};
  }

 private:
  float normal_scale_;
};

}  // namespace relight::clustered_gather
