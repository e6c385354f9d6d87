// Lights with an area: emitting triangles of the scene (both sides shine), and the rectangles and discs of a
// lighting state, which shine from one side, are not seen by the camera and block nothing. Points on them are
// chosen by emitted power; the densities serve multiple importance sampling against BRDF samples.
#pragma once

#include <vector>

#include "common/lights/area_points.h"
#include "common/scene/scene.h"

namespace relight {

// A point on an emitter. Its normal is on the shining side; on triangles, which shine on both, either may be.
struct AreaPoint {
  glm::vec3 position{0.0f}, normal{0.0f};
  glm::vec3 radiance{0.0f};
  float area_pdf = 0.0f;   // density of choosing it [1/area]; 0: there is nothing to choose
  bool on_surface = true;  // of the scene; false: in space (rectangle, disc)
};

// Where a ray meets a rectangle or disc from its shining side.
struct ShapeHit {
  glm::vec3 radiance;
  float distance, cosine, area_pdf;
};

class AreaLights {
 public:
  // triangles: do emitting surfaces count? lift: how far rectangles and discs are moved to the side on which
  // they shine (RayTracer::offset()), so that one in the plane of a ceiling lies before it, whatever rounding
  // says.
  AreaLights(const Scene& scene, const LightingState& lighting, bool triangles, float lift);

  bool empty() const { return sources_.empty(); }
  bool has_shapes() const { return !shapes_.empty(); }
  // Rectangles and discs one by one: point u of shape i, with density 1/area.
  size_t shape_count() const { return shapes_.size(); }
  AreaPoint shape_point(size_t i, const glm::vec2& u) const;
  // Chooses an emitter by u_choice and a point on it by u, all in [0,1).
  AreaPoint sample(float u_choice, const glm::vec2& u) const;
  // Density with which sample() gives a point of this triangle [1/area]; 0 if it doesn't shine.
  float triangle_pdf(uint32_t triangle) const {
    return triangle_pdf_.empty() ? 0.0f : triangle_pdf_[triangle];
  }
  // Calls hit(ShapeHit) for each rectangle and disc that the ray (unit direction) meets before t_far.
  template <typename Function>
  void for_each_shape_hit(const glm::vec3& origin, const glm::vec3& direction, float t_far,
                          Function hit) const {
    ShapeHit found{};
    for (size_t i = 0; i < shapes_.size(); ++i)
      if (meets(i, origin, direction, t_far, found)) hit(found);
  }

 private:
  struct Shape {
    AreaShape form;
    glm::vec3 radiance;
    float area_pdf = 0.0f;
  };
  struct Source {
    double cumulative;  // power up to and including this one
    uint32_t index;     // of the triangle, or of the shape
    bool is_shape;
  };
  bool meets(size_t shape, const glm::vec3& origin, const glm::vec3& direction, float t_far,
             ShapeHit& hit) const;
  void add_triangles();
  void add_shapes(const LightingState& lighting, float lift);

  const Scene& scene_;
  std::vector<Source> sources_;
  std::vector<Shape> shapes_;
  std::vector<float> triangle_pdf_;
  double power_ = 0.0;
};

}  // namespace relight
