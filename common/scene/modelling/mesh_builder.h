// Builds the flat arrays of a Scene from solids and surfaces. Closed solids face outward; positions shared by
// two faces are computed by the same expression, so that merging equal positions finds them closed.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace relight::modelling {

// Where a part stands: local (x, y, z) -> origin + x axes[0] + y axes[1] + z axes[2]. axes: rotation
// (right-handed).
struct Frame {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  glm::dvec3 point(const glm::dvec3& p) const { return origin + axes * p; }
  glm::dvec3 vector(const glm::dvec3& v) const { return axes * v; }
};

// Frame at `origin`, turned about y by `degrees`.
Frame turned(const glm::dvec3& origin, double degrees = 0.0);
// Frame at `origin` whose y axis is `up` (any length > 0).
Frame standing_along(const glm::dvec3& origin, const glm::dvec3& up);

class MeshBuilder {
 public:
  explicit MeshBuilder(Scene& scene) : scene_(scene) {}

  // Adds a material; returns its index.
  uint32_t material(const std::string& name, const glm::vec3& diffuse,
                    const glm::vec3& glossy = glm::vec3(0.0f), float exponent = 1.0f);
  uint32_t add_texture(Texture texture);
  // Triangles from now on belong to a new object and have this material.
  void object(const std::string& name, uint32_t material);
  void use_material(uint32_t material) { material_ = material; }

  uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv = {});
  // Counter-clockwise seen from outside. Triangles with two equal positions are skipped.
  void triangle(uint32_t a, uint32_t b, uint32_t c);
  void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
  // Flat parallelogram-like face a, b, c, d (counter-clockwise from outside), cut into nu x nv; uv in units
  // of length along ab and ad.
  void face(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, int nu = 1,
            int nv = 1);
  // Closed box in a frame, each face cut into `cuts` x `cuts`.
  void box(const Frame& frame, const glm::dvec3& lo, const glm::dvec3& hi, int cuts = 1);
  void box(const glm::dvec3& lo, const glm::dvec3& hi, int cuts = 1) { box(Frame(), lo, hi, cuts); }

  Scene& scene() { return scene_; }

 private:
  Scene& scene_;
  uint32_t material_ = 0, object_ = 0;
};

}  // namespace relight::modelling
