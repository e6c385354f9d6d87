// Vertices of light paths as the estimators see them.
#pragma once

#include <cmath>

#include "common/run/light_paths.h"
#include "common/sampling/surface_sample.h"

namespace relight {

inline bool black(const glm::vec3& c) { return c == glm::vec3(0.0f); }

// Squared distance and unit direction from a to b; direction 0 if they coincide.
struct Segment {
  glm::vec3 direction;
  float squared;
  Segment(const glm::vec3& a, const glm::vec3& b)
      : direction(b - a), squared(glm::dot(direction, direction)) {
    direction = squared > 0.0f ? direction * (1.0f / std::sqrt(squared)) : glm::vec3(0.0f);
  }
};

// The surface's lobes that may reflect indirect light here.
inline shader::BrdfParams allowed_brdf(const SurfaceSample& surface, const LightPaths& paths, bool at_eye) {
  shader::BrdfParams brdf = surface.brdf();
  if (!(at_eye ? paths.glossy_at_eye : paths.glossy_interior)) brdf.glossy = glm::vec3(0.0f);
  return brdf;
}

// A vertex reached from the eye.
struct EyeVertex {
  const SurfaceSample* surface = nullptr;
  shader::BrdfParams brdf;  // allowed lobes only
  glm::vec3 wo;             // towards the previous vertex
  float paths = 1.0f;  // BRDF samples taken here for each set of light vertices: m of the balance heuristic

  // f cos for light from w; 0 from behind either normal.
  glm::vec3 reflect(const glm::vec3& w) const {
    const float cosine = glm::dot(surface->shading_normal, w);
    if (!(cosine > 0.0f) || !(glm::dot(surface->geometric_normal, w) > 0.0f)) return glm::vec3(0.0f);
    return shader::brdf_eval(brdf, surface->shading_normal, wo, w) * cosine;
  }
};

// A vertex reached from a point light.
struct LightVertex {
  SurfaceSample surface;  // invalid: the light's ray left the scene
  shader::BrdfParams brdf;
  size_t light = 0;
  glm::vec3 to_light{0.0f}, irradiance{0.0f};
  float area_pdf = 0.0f;  // density of the vertex [1/area]
};

// Density over directions of a point found with `area_pdf`, with `cosine` between its normal and the line to
// it; infinite edge on.
inline float directional_pdf(float area_pdf, float squared_distance, float cosine) {
  return area_pdf * squared_distance / cosine;
}

}  // namespace relight
