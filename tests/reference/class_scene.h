// A scene in which every path class has light.
#pragma once

#include "common/brdf/brdf_lobes.h"
#include "tests/reference/render.h"
#include "tests/reference/skies.h"

namespace relight::tiny {

// A room open to an uneven sky with a GGX block, diffuse and Phong walls, and a shining quad under the
// ceiling.
inline Scene full_scene() {
  Scene scene = room(2.0f, glm::vec3(0.0f), true);
  Material ggx, lamp;
  ggx.diffuse = glm::vec3(0.3f);
  ggx.set_glossy_part(ggx_part(glm::vec3(0.4f), 0.3f, 0.3f));
  lamp.diffuse = glm::vec3(0.2f);
  lamp.emission = {2.0f, 1.5f, 1.0f};
  scene.materials[1].glossy = glm::vec3(0.0f);
  add_box(scene, {0.2f, -1.0f, -0.1f}, {0.7f, -0.4f, 0.4f}, add_material(scene, ggx));
  add_quad(scene, {-0.4f, 0.6f, -0.3f}, {0.5f, 0, 0}, {0, 0, 0.5f}, add_material(scene, lamp));
  scene.environment = uneven_map(8, 4, 0.5f);
  scene.environment.radiance = glm::vec3(0.15f);
  finish_scene(scene);
  return scene;
}

inline const LightingState local = lighting({omni({0.3f, 0.5f, 0.4f})});

inline LightPaths all_paths(int min, int max) {
  LightPaths paths = bounces(min, max, true);
  paths.emission = paths.environment = true;
  return paths;
}

}  // namespace relight::tiny
