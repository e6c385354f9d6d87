// A point on a surface with everything that shading it needs.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "common/brdf/brdf.h"

namespace relight {

struct SurfaceSample {
  glm::vec3 position{0.0f};
  glm::vec3 shading_normal{0.0f};    // unit, on the side the sample was seen from
  glm::vec3 geometric_normal{0.0f};  // unit, same side
  glm::vec3 diffuse{0.0f};           // Lambert albedo with texture applied
  glm::vec3 glossy{0.0f};            // with `exponent` and `shape`: the glossy part, see brdf_params.glsl
  glm::vec3 emission{0.0f};
  float exponent = 1.0f;
  shader::BrdfShape shape{};
  float depth = 0.0f;  // distance from the eye (view samples only)
  uint32_t triangle = 0, material = 0, object = 0;
  bool valid = false;  // false: the ray hit nothing

  shader::BrdfParams brdf() const { return {diffuse, exponent, glossy, shape}; }
};
// A large view has more than a million of them, in memory and in cached artefacts.
static_assert(sizeof(SurfaceSample) == 128);

}  // namespace relight
