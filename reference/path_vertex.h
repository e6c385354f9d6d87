// Vertices of light paths as the estimators see them.
#pragma once

#include <cmath>

#include "common/run/light_paths.h"
#include "common/sampling/surface_sample.h"
#include "reference/path_classes.h"

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

// f cos of one vertex by lobe.
struct Reflected {
  glm::vec3 diffuse{0.0f}, glossy{0.0f};
  glm::vec3 sum() const { return diffuse + glossy; }
};

inline Reflected operator*(const Reflected& r, const glm::vec3& factor) {
  return {r.diffuse * factor, r.glossy * factor};
}

// BRDF by lobe [1/sr].
inline Reflected split_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo,
                            const glm::vec3& wi) {
  Reflected f{shader::brdf_diffuse(brdf), glm::vec3(0.0f)};
  if (!black(brdf.glossy)) f.glossy = shader::brdf_glossy(brdf, n, wo, wi);
  return f;
}

// A vertex reached from the eye.
struct EyeVertex {
  const SurfaceSample* surface = nullptr;
  shader::BrdfParams brdf;  // allowed lobes only
  glm::vec3 wo;             // towards the previous vertex
  float paths = 1.0f;  // BRDF samples taken here for each set of light vertices: m of the balance heuristic

  // Becomes the vertex at `s`, which must outlive it, with its lobes that may reflect indirect light behind
  // the visible surface. Field by field: a copy of a vertex just written stalls on its half-written vector
  // loads.
  void move_to(const SurfaceSample& s, const LightPaths& allowed, const glm::vec3& towards_previous) {
    surface = &s;
    brdf.diffuse = s.diffuse;
    brdf.exponent = s.exponent;
    brdf.glossy = allowed.glossy_interior ? s.glossy : glm::vec3(0.0f);
    brdf.shape = s.shape;
    wo = towards_previous;
    paths = 1.0f;
  }

  // f cos for light from w; 0 from behind either normal.
  Reflected reflect(const glm::vec3& w) const {
    const float cosine = glm::dot(surface->shading_normal, w);
    if (!(cosine > 0.0f) || !(glm::dot(surface->geometric_normal, w) > 0.0f)) return {};
    return split_brdf(brdf, surface->shading_normal, wo, w) * glm::vec3(cosine);
  }
};

// Throughput of an eye path by lobe, as far as the vertex it has reached. At the eye vertex itself nothing
// has been split yet: `started` is false.
class Throughput {
 public:
  // Radiance if the vertex reflects `r` of it towards the eye.
  SplitRadiance reflect(const Reflected& r) const {
    SplitRadiance out;
    if (!started_) {
      out.value[0][0] = r.diffuse * split_.value[0][0];
      out.value[1][0] = r.glossy * split_.value[0][0];
      return out;
    }
    for (int eye = 0; eye < 2; ++eye) {
      out.value[eye][0] = r.diffuse * split_.value[eye][0];
      out.value[eye][1] = r.glossy * split_.value[eye][0] + r.sum() * split_.value[eye][1];
    }
    return out;
  }
  // Goes on through the vertex.
  void advance(const Reflected& r) {
    if (only_diffuse_ && black(r.glossy)) {
      split_.value[0][0] *= r.diffuse;
    } else {
      split_ = reflect(r);
      only_diffuse_ = false;
    }
    started_ = true;
  }
  // True if all vertices passed are diffuse: diffuse() is all of it.
  bool only_diffuse() const { return only_diffuse_; }
  const glm::vec3& diffuse() const { return split_.value[0][0]; }
  void scale(float factor) {
    for (auto& eye : split_.value)
      for (glm::vec3& v : eye) v *= factor;
  }
  glm::vec3 sum() const { return only_diffuse_ ? diffuse() : split_.sum(); }
  // Radiance from what the path has hit, which emits `radiance`.
  SplitRadiance emitted(const glm::vec3& radiance) const {
    SplitRadiance out = split_;
    for (auto& eye : out.value)
      for (glm::vec3& v : eye) v *= radiance;
    return out;
  }

 private:
  bool started_ = false, only_diffuse_ = true;
  SplitRadiance split_{{{glm::vec3(1.0f), glm::vec3(0.0f)}, {glm::vec3(0.0f), glm::vec3(0.0f)}}};
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
