#include "common/scene/files/framing.h"

#include <cmath>

#include "common/scene/builtin/builtin.h"

namespace relight {

namespace {

constexpr float centre_irradiance =
    3.0f;  // a surface of albedo 0.5 facing the light gets a radiance of about 0.5

glm::vec3 intensity_at(float distance) { return glm::vec3(centre_irradiance * distance * distance); }

}  // namespace

Camera frame_bounds(const Bounds& bounds) {
  Camera camera;
  camera.fov_y_degrees = 45.0f;
  const float distance = 0.5f * bounds.diagonal() / std::sin(glm::radians(0.5f * camera.fov_y_degrees));
  camera.target = bounds.centre();
  camera.eye = camera.target + distance * glm::normalize(glm::vec3(0.4f, 0.35f, 1.0f));
  return camera;
}

void add_default_lightings(Scene& scene) {
  const glm::vec3 centre = scene.bounds.centre();
  const float size = scene.bounds.diagonal();
  const glm::vec3 beside = scene.camera.eye + 0.3f * size * glm::vec3(-1.0f, 1.0f, 0.0f);
  add_lighting(scene, "omni", {omni_light(beside, intensity_at(glm::length(beside - centre)))});
  const glm::vec3 above = centre + size * glm::vec3(0.3f, 1.2f, 0.2f);
  const float distance = glm::length(above - centre);
  const float outer = glm::degrees(std::atan(size / 6.0f / distance));
  add_lighting(scene, "spot", {spot_light(above, centre, intensity_at(distance), 0.8f * outer, outer)});
}

}  // namespace relight
