// The scene as every part of relight sees it: flat arrays of vertices and triangles, materials, textures,
// a camera, an exposure, named light presets and an environment. Built by scene_file.h (files) or
// builtin_scenes.h (procedural), checked and repaired by validation.h; read-only afterwards.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "common/lights/environment.h"
#include "common/lights/light.h"
#include "common/scene/camera.h"
#include "common/scene/material.h"

namespace relight {

struct Triangle {
  uint32_t v[3];          // indices into Scene::positions / normals / uvs
  uint32_t material = 0;  // index into Scene::materials
  uint32_t object = 0;    // index into Scene::object_names
};

// Axis-aligned box; empty when lo > hi.
struct Bounds {
  glm::vec3 lo{1e30f}, hi{-1e30f};
  void add(const glm::vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  glm::vec3 centre() const { return 0.5f * (lo + hi); }
  float diagonal() const { return lo.x > hi.x ? 0.0f : glm::length(hi - lo); }
};

// What loading changed or found out; printed by `relight scene info` and stored in run records.
struct RepairReport {
  std::map<std::string, int64_t> counts;  // e.g. "zero_area_triangles_removed" -> 12; only non-zero entries
  std::vector<std::string> warnings;      // one sentence each, naming file and object
};

struct Scene {
  std::string name;                  // built-in name or file path
  std::vector<glm::vec3> positions;  // scene units
  std::vector<glm::vec3> normals;    // unit shading normals, one per vertex
  std::vector<glm::vec2> uvs;        // one per vertex; (0,0) where the file had none
  std::vector<Triangle> triangles;
  std::vector<Material> materials;  // at least one
  std::vector<Texture> textures;
  std::vector<std::string> object_names;
  Camera camera;
  std::map<std::string, Camera> views;  // further cameras by name; `--view NAME:640x480` chooses one
  float exposure = 1.0f;  // fixed factor applied to radiance before the clamp of the `relative` metric
  std::map<std::string, LightingState> lightings;  // named presets ("spot", "omni", ...)
  Environment environment;
  Bounds bounds;              // of all referenced vertices
  uint64_t content_hash = 0;  // of everything that can change a picture, except camera and lights
  RepairReport repairs;

  // Geometric (unnormalised) normal of triangle t: cross product of its edges; length = 2 x area.
  glm::vec3 area_normal(size_t t) const {
    const Triangle& tri = triangles[t];
    const glm::vec3 a = positions[tri.v[0]];
    return glm::cross(positions[tri.v[1]] - a, positions[tri.v[2]] - a);
  }
};

// Computes bounds and content_hash; call after any change to geometry, materials or textures.
void finish_scene(Scene& scene);

}  // namespace relight
