#include "common/lights/light.h"
#include "common/finite.h"

#include <cmath>

#include "common/run/error.h"

namespace relight {

namespace {

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

void validate_beam(const Light& light, const std::string& who) {
  const BeamShape& b = light.beam;
  const auto check = [&](const char* field, float value, bool valid, const char* range) {
    if (!std::isfinite(value) || !valid) fail("{}: {} is {}; valid: {}", who, field, value, range);
  };
  check("width", b.width, b.width > 0.0f, "a finite number > 0");
  check("height", b.height, b.height > 0.0f, "a finite number > 0");
  check("width_edge", b.width_edge, b.width_edge >= 0.0f, "a finite number >= 0");
  check("height_edge", b.height_edge, b.height_edge >= 0.0f, "a finite number >= 0");
  check("roundness", b.roundness, b.roundness >= 0.0f && b.roundness <= 1.0f, "0 to 1");
  check("shear_x", b.shear_x, true, "a finite number");
  check("shear_y", b.shear_y, true, "a finite number");
  check("cut_on", b.cut_on, b.cut_on < b.cut_off, "below cut_off");
  check("near_edge", b.near_edge, b.near_edge >= 0.0f, "a finite number >= 0");
  check("cut_off", b.cut_off, b.cut_off > 0.0f, "a finite number > 0");
  check("far_edge", b.far_edge, b.far_edge >= 0.0f, "a finite number >= 0");
  check("falloff", b.falloff, b.falloff >= 0.0f, "a finite number >= 0");
  check("falloff_distance", b.falloff_distance, b.falloff_distance > 0.0f, "a finite number > 0");
  const float skew = glm::dot(light.right, glm::normalize(light.direction));
  if (!(std::abs(glm::length(light.right) - 1.0f) < 1e-4f) || !(std::abs(skew) < 2e-4f))
    fail("{}: right is {}; it must be of unit length and perpendicular to direction {}", who,
         show(light.right), show(light.direction));
}

void validate_sky(const Light& light, const std::string& who) {
  const SkySettings& s = light.sky;
  if (!(s.elevation_degrees >= least_elevation_degrees && s.elevation_degrees <= 90.0f))
    fail("{}: elevation_degrees is {}; valid: {} to 90", who, s.elevation_degrees, least_elevation_degrees);
  if (!(s.turbidity >= least_turbidity && s.turbidity <= largest_turbidity))
    fail("{}: turbidity is {}; valid: {} to {}", who, s.turbidity, least_turbidity, largest_turbidity);
  if (!std::isfinite(s.azimuth_degrees)) fail("{}: azimuth_degrees is {}", who, s.azimuth_degrees);
  if (!(s.scale >= 0.0f && std::isfinite(s.scale)))
    fail("{}: scale is {}; valid: a finite number >= 0", who, s.scale);
}

}  // namespace

void require_no_shader(const Light& light, const char* who) {
  if (light.type == LightType::shader)
    fail(
        "{}: light '{}' is GLSL from '{}', which runs on the GPU only; valid here: omni, spot, directional, "
        "rectangle, disc, projector, uber, sun_sky",
        who, light.name, light.user_shader ? light.user_shader->file : "");
}

shader::LightParams Light::params() const {
  if (has_area(type)) fail("light '{}': a light with an area (rectangle, disc) is not one point", name);
  // In double: near 0 degrees the cosine of a float angle keeps only half of its digits.
  const auto cosine = [](float degrees) {
    return static_cast<float>(std::cos(glm::radians(double(degrees))));
  };
  const bool bare = has_beam(type) || type == LightType::shader;  // what shapes these comes on top
  const int code = bare ? 0 : is_parallel(type) ? 2 : static_cast<int>(type);
  const glm::vec3 axis = type == LightType::omni ? glm::vec3(0.0f, -1.0f, 0.0f) : glm::normalize(direction);
  shader::LightParams p;
  p.position_type = glm::vec4(position, static_cast<float>(code));
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
    if (has_beam(light.type)) validate_beam(light, who);
    if (light.type == LightType::sun_sky) validate_sky(light, who);
    if (light.type == LightType::shader && !light.user_shader) fail("{}: a shader light without a file", who);
    if (light.type == LightType::disc && !(light.radius > 0.0f && std::isfinite(light.radius)))
      fail("{}: radius is {}; a disc needs a finite radius > 0", who, light.radius);
  }
}

}  // namespace relight
