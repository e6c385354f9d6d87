// What shading code adds light from: an omni, spot or directional light as it is, a light with an area as
// several points on it.
#pragma once

#include <memory>
#include <vector>

#include "common/lights/light.h"

namespace relight {

// A beam as shading code reads it.
struct Beam {
  shader::BeamParams params;
  std::shared_ptr<const Slide> slide;  // never null
  glm::vec3 factor(const glm::vec3& rel) const {
    return shader::beam_factor(params, slide->texels.data(), rel);
  }
};

// GLSL that shapes the light, with what it is given.
struct UserLight {
  std::shared_ptr<const UserLightShader> shader;
  std::array<glm::vec3, 8> parameters;
  glm::mat3 axes;  // columns right, up, forward
};

struct Emitter {
  shader::LightParams params;
  bool casts_shadows = true;
  // Half-angle of a cone around params.direction_outer outside of which it gives no light; 180: everywhere.
  float cone_degrees = 180.0f;
  std::shared_ptr<const Beam> beam;  // null for most
  // Null for most. Not part of irradiance(), which is then that of a bare point: only the GPU runs it.
  std::shared_ptr<const UserLight> user;

  bool is_directional() const { return params.position_type.w > 1.5f; }
  glm::vec3 position() const { return glm::vec3(params.position_type); }
  glm::vec3 axis() const { return glm::vec3(params.direction_outer); }  // unit, where it shines
  // Unit direction from a point to the light.
  glm::vec3 direction_from(const glm::vec3& p) const { return shader::light_direction(params, p); }
  // Unshadowed irradiance [W/m^2]; see light_irradiance in light_models.glsl
  // and beam_factor in beam.glsl.
  glm::vec3 irradiance(const glm::vec3& p, const glm::vec3& ns, const glm::vec3& ng) const {
    const glm::vec3 bare = shader::light_irradiance(params, p, ns, ng);
    return beam && bare != glm::vec3(0.0f) ? bare * beam->factor(p - position()) : bare;
  }
};

// The emitter of a light without area. Throws Error for a rectangle or disc.
Emitter emitter_of(const Light& light);

// One emitter, or for a rectangle or disc `area_samples` of them: points of a stratified set, each with the
// intensity radiance x area / area_samples on its normal and the emitter's cosine elsewhere. As the number
// grows their light converges to that of the area. lift: how far a light with an area is moved along its
// direction (RayTracer::offset()), so that one in the plane of a ceiling lies before it, whatever rounding
// says.
std::vector<Emitter> emitters_of(const Light& light, int area_samples, float lift);

}  // namespace relight
