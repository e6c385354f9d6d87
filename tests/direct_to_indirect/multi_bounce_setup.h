// Closed rooms and their gather clouds for the tests of the multiple-bounce matrix.
#pragma once

#include <algorithm>
#include <utility>

#include "common/tracing/ray_tracer.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/multi_bounce.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {

// The unit cube of one albedo, normals outwards.
inline Scene closed_box(const glm::vec3& albedo) {
  Scene scene = tiny::empty_scene(albedo);
  tiny::add_box(scene, glm::vec3(0.0f), glm::vec3(1.0f));
  finish_scene(scene);
  return scene;
}

// A sphere of radius 1: a closed room without edges.
inline Scene closed_sphere(const glm::vec3& albedo) {
  Scene scene = tiny::empty_scene(albedo);
  tiny::add_sphere(scene, glm::vec3(0.0f), 1.0f, 48);
  finish_scene(scene);
  return scene;
}

// A scene with samples spread evenly over one side of its surfaces.
struct BounceSetup {
  Scene scene;
  RayTracer tracer;
  GatherCloud cloud;
  GatherHierarchy hierarchy;
  std::vector<float> column_scale;

  BounceSetup(Scene s, int64_t samples, bool flipped) : scene(std::move(s)), tracer(scene) {
    std::vector<SurfacePiece> pieces = cut_surfaces(scene, 1e30);
    std::erase_if(pieces, [flipped](const SurfacePiece& p) { return p.flipped != flipped; });
    cloud = make_gather_cloud(tracer, pieces, samples, 1);
    order_gather_cloud(cloud, 30.0f, scene.bounds.diagonal());
    hierarchy = build_hierarchy(cloud);
  }

  MultiBounceInput input() const { return {tracer, cloud, hierarchy, column_scale}; }

  MultiBounce compute(const MultiBounceSettings& settings, StageLog& log) const {
    Progress quiet(true);
    return compute_multi_bounce(input(), settings, quiet, log);
  }
  MultiBounce compute(const MultiBounceSettings& settings) const {
    StageLog log;
    return compute(settings, log);
  }
};

// Few photons, links fine enough that they cost no accuracy to speak of.
inline MultiBounceSettings quick_settings(BounceKind kind, int bounces) {
  MultiBounceSettings settings;
  settings.kind = kind;
  settings.bounces = bounces;
  settings.photons = 100000;
  settings.neighbours = 300;
  settings.gather.link_threshold = 0.02f;
  return settings;
}

// M g: what the bounces add to light g that leaves the samples. No column scaling.
inline std::vector<glm::dvec3> bounced(const BounceSetup& s, const MultiBounce& m,
                                       const std::vector<glm::dvec3>& g) {
  if (m.photons.rows() > 0) return multiply(m.photons, wavelet::forward(g));
  std::vector<glm::dvec3> light = g;
  for (int bounce = 1; bounce < m.bounces; ++bounce) {
    const std::vector<glm::vec3> arriving = multiply(m.transfer, wavelet::forward(light));
    for (size_t i = 0; i < g.size(); ++i)
      light[i] = g[i] + glm::dvec3(s.cloud.samples[i].diffuse) * glm::dvec3(arriving[i]);
  }
  for (size_t i = 0; i < g.size(); ++i) light[i] -= g[i];
  return light;
}

// Distance of a point of the unit cube's surface from the nearest edge.
inline float edge_distance(const glm::vec3& p) {
  float d[3];
  for (int axis = 0; axis < 3; ++axis) d[axis] = std::min(p[axis], 1.0f - p[axis]);
  std::sort(d, d + 3);
  return d[1];  // d[0] is 0 on a face
}

}  // namespace relight::direct_to_indirect
