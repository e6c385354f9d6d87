#include "common/lights/emitter.h"

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

}  // namespace

Emitter emitter_of(const Light& light) {
  Emitter emitter;
  emitter.params = light.params();
  emitter.casts_shadows = light.casts_shadows;
  if (light.type == LightType::spot) emitter.cone_degrees = light.outer_degrees;
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
