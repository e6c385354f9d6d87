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

// rectangle and disc are seen by surfaces but not by the camera, shine from one side only and block nothing.
enum class LightType { omni = 0, spot = 1, directional = 2, rectangle = 3, disc = 4 };

// False for lights that shine from one place or one direction: their shadows are sharp.
inline bool has_area(LightType type) { return type == LightType::rectangle || type == LightType::disc; }

// Linear RGB. The unit of intensity depends on the type: W/sr (omni, spot), W/m^2 facing the light
// (directional), or radiance in W/(m^2 sr) (rectangle, disc).
struct Light {
  std::string name;
  LightType type = LightType::omni;
  glm::vec3 position{0.0f};  // centre of a rectangle or disc; unused for directional
  // Unit: where a spot, directional, rectangle or disc shines; unused for omni.
  glm::vec3 direction{0, -1, 0};
  glm::vec3 edge_u{0.0f}, edge_v{0.0f};  // rectangle: from its centre to the middles of two sides
  float radius = 0.0f;                   // disc
  glm::vec3 intensity{1.0f};             // on the axis for a spot
  float inner_degrees = 20.0f;           // spot: half-angle of full intensity
  float outer_degrees = 25.0f;           // spot: half-angle where the intensity reaches zero; > inner
  bool casts_shadows = true;

  // The form the shading code (C++ and GLSL) reads. Throws Error for lights with an area, which are made of
  // many points: see emitter.h.
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
