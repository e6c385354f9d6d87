// Local lights and lighting states. The light models themselves (intensity as a function of direction) are
// written once, in light_models.glsl, and compiled here as C++ and on the GPU as GLSL.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "common/glsl_in_cpp.h"
#include "common/lights/sky.h"
#include "common/lights/slide.h"

namespace relight {

namespace shader {
using namespace glm;
#include "common/lights/beam.glsl"
#include "common/lights/light_models.glsl"
}  // namespace shader

// rectangle and disc are seen by surfaces but not by the camera, shine from one side only and block nothing.
enum class LightType { omni, spot, directional, rectangle, disc, projector, uber, sun_sky, shader };
inline constexpr int light_type_count = 9;

// False for lights that shine from one place or one direction: their shadows are sharp.
inline bool has_area(LightType type) { return type == LightType::rectangle || type == LightType::disc; }

// True for lights that are a point behind a shape and a slide.
inline bool has_beam(LightType type) { return type == LightType::projector || type == LightType::uber; }

// What of a point's light passes; see beam.glsl. A projector's is a rectangle with hard edges. Widths,
// heights and shears are lengths at unit distance from the light, measured from the axis; cuts and distances
// are in scene units.
struct BeamShape {
  float width = 1.0f, height = 1.0f;            // half of the beam
  float width_edge = 0.0f, height_edge = 0.0f;  // beyond it, where light fades out
  float roundness = 0.0f;                       // 0: a rectangle .. 1: an ellipse
  float shear_x = 0.0f, shear_y = 0.0f;         // of the beam's centre
  float cut_on = 0.0f, near_edge = 0.0f;   // full light from this depth on, none from near_edge before it
  float cut_off = 1e30f, far_edge = 0.0f;  // full light up to this depth, none from far_edge behind it
  float falloff = 2.0f;                    // irradiance falls with distance to this power ...
  float falloff_distance = 1.0f;           // ... and is intensity / distance^2 here
  static BeamShape uber() { return {0.5f, 0.5f, 0.05f, 0.05f, 1.0f}; }
  bool operator==(const BeamShape&) const = default;
};

// A light's own GLSL; its file defines user_light() as common/lights/user_light.glsl does.
struct UserLightShader {
  std::string file, text;
  uint64_t content_hash = 0;  // of text
};

// Linear RGB. The unit of intensity depends on the type: W/sr (omni, spot, projector, uber), W/m^2 facing the
// light (directional, sun_sky), or radiance in W/(m^2 sr) (rectangle, disc).
struct Light {
  std::string name;
  LightType type = LightType::omni;
  glm::vec3 position{0.0f};  // centre of a rectangle or disc; unused for directional
  // Unit: where a light shines; unused for omni.
  glm::vec3 direction{0, -1, 0};
  glm::vec3 edge_u{0.0f}, edge_v{0.0f};  // rectangle: from its centre to the middles of two sides
  float radius = 0.0f;                   // disc
  glm::vec3 intensity{1.0f};             // on the axis for a spot
  float inner_degrees = 20.0f;           // spot: half-angle of full intensity
  float outer_degrees = 25.0f;           // spot: half-angle where the intensity reaches zero; > inner
  bool casts_shadows = true;
  glm::vec3 right{1, 0, 0};  // projector, uber, shader: unit, to the right of the slide; up is what remains
  BeamShape beam;            // projector, uber
  std::shared_ptr<const Slide> slide;  // projector, uber: null for plain light
  // sun_sky: direction and intensity are the sun's, made of this; the sky is LightingState::environment.
  SkySettings sky;
  std::shared_ptr<const UserLightShader> user_shader;  // shader: GLSL, on the GPU only
  std::array<glm::vec3, 8> parameters{};               // shader: what its function is given

  // The form the shading code (C++ and GLSL) reads. Throws Error for lights with an area, which are made of
  // many points: see emitter.h.
  shader::LightParams params() const;
};

struct LightAnimation;

// True if the type's light is parallel.
inline bool is_parallel(LightType type) {
  return type == LightType::directional || type == LightType::sun_sky;
}

// Everything about lighting that may change between frames.
struct LightingState {
  std::string name;
  std::vector<Light> lights;
  std::shared_ptr<const LightAnimation> animation = nullptr;  // how the lights move; see light_animation.h
  // In place of the scene's environment; null: that one. Set by a sun_sky light.
  std::shared_ptr<const Environment> environment = nullptr;
  const Environment& environment_or(const Environment& of_scene) const {
    return environment ? *environment : of_scene;
  }
};

// Throws Error naming the light and field if a value is not finite or out of range.
void validate(const LightingState& lighting);

// Throws Error for a light of type shader: GLSL does not run on the CPU. `who` begins the message.
void require_no_shader(const Light& light, const char* who);

}  // namespace relight
