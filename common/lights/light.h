// Local lights and lighting states. The light models themselves (intensity as a function of direction) are
// written once, in light_models.glsl, and compiled here as C++ and on the GPU as GLSL.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "common/glsl_in_cpp.h"

namespace relight {

namespace shader {
using namespace glm;
#include "common/lights/light_models.glsl"
}  // namespace shader

enum class LightType { omni = 0, spot = 1 };

// A point light. Intensities in W/sr, linear RGB.
struct Light {
  std::string name;
  LightType type = LightType::omni;
  glm::vec3 position{0.0f};
  glm::vec3 direction{0, -1, 0};  // spot axis, unit; unused for omni
  glm::vec3 intensity{1.0f};      // on the axis for a spot
  float inner_degrees = 20.0f;    // spot: half-angle of full intensity
  float outer_degrees = 25.0f;    // spot: half-angle where the intensity reaches zero; > inner
  bool casts_shadows = true;

  // The form the shading code (C++ and GLSL) reads.
  shader::LightParams params() const;
};

// Everything about lighting that may change between frames.
struct LightingState {
  std::string name;
  std::vector<Light> lights;
};

// Throws Error naming the light and field if a value is not finite or out of range.
void validate(const LightingState& lighting);

}  // namespace relight
