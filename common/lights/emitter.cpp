#include "common/lights/emitter.h"

#include <cmath>

#include "common/lights/area_points.h"

namespace relight {

namespace {

constexpr float point_of_area = -1.0f;  // in LightParams::position_type.w

Emitter point_of(const Light& light, const AreaShape& shape, const glm::vec2& u, int area_samples) {
  Emitter emitter;
  emitter.casts_shadows = light.casts_shadows;
  emitter.cone_degrees = 90.0f;
  const glm::vec3 intensity = light.intensity * (shape.area / static_cast<float>(area_samples));
  emitter.params.position_type = glm::vec4(shape.point(u), point_of_area);
  emitter.params.direction_outer = glm::vec4(shape.normal, 0.0f);
  emitter.params.intensity_inner = glm::vec4(intensity, 1.0f);
  return emitter;
}

std::shared_ptr<const Beam> beam_of(const Light& light) {
  static const auto plain = std::make_shared<const Slide>();
  const BeamShape& b = light.beam;
  const glm::vec3 forward = glm::normalize(light.direction), right = light.right;
  Beam beam;
  beam.slide = light.slide ? light.slide : plain;
  beam.params.right_width = glm::vec4(right, b.width);
  beam.params.up_height = glm::vec4(glm::cross(right, forward), b.height);
  beam.params.forward_roundness = glm::vec4(forward, b.roundness);
  beam.params.edges_shear = glm::vec4(b.width_edge, b.height_edge, b.shear_x, b.shear_y);
  beam.params.cuts = glm::vec4(b.cut_on, b.near_edge, b.cut_off, b.far_edge);
  beam.params.falloff_slide =
      glm::vec4(2.0f - b.falloff, 1.0f / b.falloff_distance, static_cast<float>(beam.slide->width),
                static_cast<float>(beam.slide->height));
  return std::make_shared<const Beam>(beam);
}

// Of a cone around the axis that holds the beam's outer rectangle, with some roundings to spare.
float cone_degrees_of(const BeamShape& b) {
  const float x = std::abs(b.shear_x) + b.width + b.width_edge,
              y = std::abs(b.shear_y) + b.height + b.height_edge;
  return glm::degrees(std::atan(std::sqrt(x * x + y * y))) * (1.0f + 1e-6f);
}

}  // namespace

Emitter emitter_of(const Light& light) {
  Emitter emitter;
  emitter.params = light.params();
  emitter.casts_shadows = light.casts_shadows;
  if (light.type == LightType::spot) emitter.cone_degrees = light.outer_degrees;
  if (has_beam(light.type)) {
    emitter.beam = beam_of(light);
    emitter.cone_degrees = cone_degrees_of(light.beam);
  }
  if (light.type == LightType::shader) {
    const glm::vec3 forward = glm::normalize(light.direction);
    const glm::mat3 axes(light.right, glm::cross(light.right, forward), forward);
    emitter.user = std::make_shared<const UserLight>(UserLight{light.user_shader, light.parameters, axes});
  }
  return emitter;
}

std::vector<Emitter> emitters_of(const Light& light, int area_samples, float lift) {
  if (!has_area(light.type)) return {emitter_of(light)};
  const AreaShape shape(light, lift);
  std::vector<Emitter> points;
  for (int i = 0; i < area_samples; ++i)
    points.push_back(point_of(light, shape,
                              stratified_point(static_cast<uint32_t>(i), static_cast<uint32_t>(area_samples)),
                              area_samples));
  return points;
}

}  // namespace relight
