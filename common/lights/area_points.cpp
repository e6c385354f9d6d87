#include "common/lights/area_points.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "common/brdf/brdf.h"

namespace relight {

glm::vec2 square_to_disc(const glm::vec2& u) {
  const float x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
  if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
  constexpr float quarter_pi = 0.25f * std::numbers::pi_v<float>;
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y;
  const float phi = wide ? quarter_pi * (y / x) : 2.0f * quarter_pi - quarter_pi * (x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

glm::vec2 stratified_point(uint32_t i, uint32_t n) {
  const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
  const uint32_t strata = std::bit_ceil(n);
  double radical_inverse = 0.0, digit = 0.5;
  for (uint32_t rest = i; rest != 0; rest >>= 1, digit *= 0.5) radical_inverse += (rest & 1u) * digit;
  return {static_cast<float>(x), static_cast<float>(radical_inverse + 0.5 / static_cast<double>(strata))};
}

AreaShape::AreaShape(const Light& light, float lift)
    : normal(glm::normalize(light.direction)),
      u(light.edge_u),
      v(light.edge_v),
      is_disc(light.type == LightType::disc) {
  centre = light.position + lift * normal;
  if (is_disc) {
    const glm::mat3 frame = frame_around(normal);
    u = light.radius * frame[0], v = light.radius * frame[1];
  }
  area = glm::length(glm::cross(u, v)) * (is_disc ? std::numbers::pi_v<float> : 4.0f);
}

glm::vec3 AreaShape::point(const glm::vec2& square) const {
  const glm::vec2 at = is_disc ? square_to_disc(square) : 2.0f * square - glm::vec2(1.0f);
  return centre + at.x * u + at.y * v;
}

}  // namespace relight
