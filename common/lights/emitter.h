// What shading code adds light from: an omni, spot or directional light as it is, a light with an area as
// several points on it.
#pragma once

#include <vector>

#include "common/lights/light.h"

namespace relight {

struct Emitter {
  shader::LightParams params;
  bool casts_shadows = true;
  // Half-angle of a cone around params.direction_outer outside of which it gives no light; 180: everywhere.
  float cone_degrees = 180.0f;

  bool is_directional() const { return params.position_type.w > 1.5f; }
  glm::vec3 position() const { return glm::vec3(params.position_type); }
  glm::vec3 axis() const { return glm::vec3(params.direction_outer); }  // unit, where it shines
  // Unit direction from a point to the light.
  glm::vec3 direction_from(const glm::vec3& p) const { return shader::light_direction(params, p); }
  // Unshadowed irradiance [W/m^2]; see light_irradiance in light_models.glsl.
  glm::vec3 irradiance(const glm::vec3& p, const glm::vec3& ns, const glm::vec3& ng) const {
    return shader::light_irradiance(params, p, ns, ng);
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
