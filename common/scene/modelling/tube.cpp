#include <cmath>
#include <numbers>

#include "common/scene/modelling/surfaces.h"

namespace relight::modelling {

void tube(MeshBuilder& mesh, const std::vector<glm::dvec3>& curve, double radius, double end_radius,
          int sides) {
  const size_t n = curve.size();
  const auto tangent = [&](size_t i) {
    return glm::normalize(curve[std::min(i + 1, n - 1)] - curve[i > 0 ? i - 1 : 0]);
  };
  // Parallel transport: the cross-section is carried along without twist.
  glm::dvec3 across = standing_along(curve[0], tangent(0)).axes[0];
  const auto first = static_cast<uint32_t>(mesh.scene().positions.size());
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 t = tangent(i);
    across = glm::normalize(across - t * glm::dot(across, t));
    const glm::dvec3 other = glm::cross(across, t);
    const double along = double(i) / double(n - 1);
    const double r = glm::mix(radius, end_radius, along);
    for (int k = 0; k < sides; ++k) {
      const double a = 2.0 * std::numbers::pi * k / sides;
      const glm::dvec3 out = std::cos(a) * across + std::sin(a) * other;
      mesh.vertex(curve[i] + r * out, out, {double(k) / sides, along});
    }
  }
  const auto ring = [&](size_t i, int k) {
    return first + static_cast<uint32_t>(static_cast<int>(i) * sides + k % sides);
  };
  for (size_t i = 0; i + 1 < n; ++i)
    for (int k = 0; k < sides; ++k) mesh.quad(ring(i, k), ring(i + 1, k), ring(i + 1, k + 1), ring(i, k + 1));
  const auto cap = [&](size_t i, const glm::dvec3& normal, bool start) {
    const auto base = static_cast<uint32_t>(mesh.scene().positions.size());
    for (int k = 0; k < sides; ++k) mesh.vertex(mesh.scene().positions[ring(i, k)], normal);
    for (uint32_t k = 1; k + 1 < static_cast<uint32_t>(sides); ++k)
      start ? mesh.triangle(base, base + k, base + k + 1) : mesh.triangle(base, base + k + 1, base + k);
  };
  cap(0, -tangent(0), true);
  cap(n - 1, tangent(n - 1), false);
}

}  // namespace relight::modelling
