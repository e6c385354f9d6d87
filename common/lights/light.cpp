#include "common/lights/light.h"

#include <cmath>

#include "common/run/error.h"

namespace relight {

namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string show(const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

void validate_spot(const Light& light, const std::string& who) {
  if (!finite(light.direction) || !(glm::length(light.direction) > 0.0f))
    fail("{}: direction is {}; a spot needs a finite direction of non-zero length", who,
         show(light.direction));
  if (!(light.inner_degrees >= 0.0f && light.inner_degrees < light.outer_degrees &&
        light.outer_degrees < 90.0f))
    fail("{}: inner_degrees is {} and outer_degrees {}; valid: 0 <= inner_degrees < outer_degrees < 90", who,
         light.inner_degrees, light.outer_degrees);
  const shader::LightParams params = light.params();
  if (!(params.intensity_inner.w > params.direction_outer.w))
    fail(
        "{}: inner_degrees {} and outer_degrees {} are too close: their cosines are equal in single "
        "precision",
        who, light.inner_degrees, light.outer_degrees);
}

void validate_rectangle(const Light& light, const std::string& who) {
  const float area = 4.0f * glm::length(glm::cross(light.edge_u, light.edge_v));
  if (!std::isfinite(area) || !(area > 0.0f))
    fail("{}: edge_u is {} and edge_v {}; a rectangle needs an area", who, show(light.edge_u),
         show(light.edge_v));
  // Rays and points drawn from the light would see different shapes. A hundredth of a degree is rounding.
  const auto skewed = [](const glm::vec3& a, const glm::vec3& b) {
    return std::abs(glm::dot(glm::normalize(a), glm::normalize(b))) > 2e-4f;
  };
  if (skewed(light.edge_u, light.edge_v) || skewed(light.edge_u, light.direction) ||
      skewed(light.edge_v, light.direction))
    fail("{}: edge_u is {}, edge_v {} and direction {}; they must be perpendicular to each other", who,
         show(light.edge_u), show(light.edge_v), show(light.direction));
}

}  // namespace

shader::LightParams Light::params() const {
  if (has_area(type)) fail("light '{}': a light with an area (rectangle, disc) is not one point", name);
  // In double: near 0 degrees the cosine of a float angle keeps only half of its digits.
  const auto cosine = [](float degrees) {
    return static_cast<float>(std::cos(glm::radians(double(degrees))));
  };
  const glm::vec3 axis = type == LightType::omni ? glm::vec3(0.0f, -1.0f, 0.0f) : glm::normalize(direction);
  shader::LightParams p;
  p.position_type = glm::vec4(position, static_cast<float>(type));
  p.direction_outer = glm::vec4(axis, cosine(outer_degrees));
  p.intensity_inner = glm::vec4(intensity, cosine(inner_degrees));
  return p;
}

void validate(const LightingState& lighting) {
  for (size_t i = 0; i < lighting.lights.size(); ++i) {
    const Light& light = lighting.lights[i];
    const std::string who = light.name.empty()
                                ? fmt::format("lighting '{}': light {}", lighting.name, i + 1)
                                : fmt::format("lighting '{}': light '{}'", lighting.name, light.name);
    if (!finite(light.position)) fail("{}: position is {}; it must be finite", who, show(light.position));
    if (!finite(light.intensity) || glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f))))
      fail("{}: intensity is {}; valid: finite values >= 0", who, show(light.intensity));
    if (light.type == LightType::spot) validate_spot(light, who);
    if (light.type > LightType::spot && (!finite(light.direction) || !(glm::length(light.direction) > 0.0f)))
      fail("{}: direction is {}; it must be finite and have a length", who, show(light.direction));
    if (has_area(light.type) && !light.casts_shadows)
      fail("{}: casts_shadows is false; valid for a light with an area: true", who);
    if (light.type == LightType::rectangle) validate_rectangle(light, who);
    if (light.type == LightType::disc && !(light.radius > 0.0f && std::isfinite(light.radius)))
      fail("{}: radius is {}; a disc needs a finite radius > 0", who, light.radius);
  }
}

}  // namespace relight
