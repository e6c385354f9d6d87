// Rectangles and discs as lights, and the same as emitting meshes.
#pragma once

#include "tests/support/form_factors.h"
#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::tiny {

// Shines along cross(a, b) of the rectangle, as its front does.
inline Light rectangle_light(const check::Rectangle& r, const glm::vec3& radiance) {
  Light light;
  light.name = "rectangle";
  light.type = LightType::rectangle;
  light.position = glm::vec3(r.at(0.5, 0.5));
  light.direction = glm::vec3(r.normal());
  light.edge_u = glm::vec3(0.5 * r.a), light.edge_v = glm::vec3(0.5 * r.b);
  light.intensity = radiance;
  return light;
}

inline Light disc_light(const glm::dvec3& centre, const glm::dvec3& direction, double radius,
                        const glm::vec3& radiance) {
  Light light;
  light.name = "disc";
  light.type = LightType::disc;
  light.position = glm::vec3(centre);
  light.direction = glm::vec3(glm::normalize(direction));
  light.radius = static_cast<float>(radius);
  light.intensity = radiance;
  return light;
}

inline void add_rectangle(Scene& scene, const check::Rectangle& r, uint32_t material = 0) {
  add_quad(scene, glm::vec3(r.corner), glm::vec3(r.a), glm::vec3(r.b), material);
}

// Reflects nothing.
inline Material black_material(const glm::vec3& emission = glm::vec3(0.0f)) {
  Material material;
  material.diffuse = glm::vec3(0.0f);
  material.emission = emission;
  return material;
}

constexpr double floor_albedo = 0.8;
inline const check::Rectangle floor_plate{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}};

inline Scene floor_scene() {
  Scene scene = empty_scene(glm::vec3(static_cast<float>(floor_albedo)));
  add_rectangle(scene, floor_plate);
  finish_scene(scene);
  return scene;
}

// Radiance of the floor at p, lit by lights with an area alone, seen from a slant above.
inline check::Reading read_floor(const check::RadianceMeter& meter, const glm::dvec3& p, int samples = 256) {
  return meter.read(glm::vec3(p + glm::dvec3(0.05, 0.1, 0.02)), glm::vec3(p), {0, 0, true}, {samples, 24});
}

}  // namespace relight::tiny
