// Hand-made scenes for hard cases and tests: quads, boxes and spheres with known answers. Header only.
#pragma once

#include <cmath>
#include <initializer_list>

#include <glm/glm.hpp>

#include "common/scene/scene.h"

namespace relight::tiny {

// A scene with one material and no geometry.
inline Scene empty_scene(const glm::vec3& diffuse = glm::vec3(0.5f)) {
  Scene scene;
  scene.name = "tiny";
  scene.materials.push_back({});
  scene.materials[0].diffuse = diffuse;
  scene.object_names.push_back("object");
  return scene;
}

inline uint32_t add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

inline uint32_t add_vertex(Scene& scene, const glm::vec3& p, const glm::vec3& n,
                           const glm::vec2& uv = glm::vec2(0.0f)) {
  scene.positions.push_back(p);
  scene.normals.push_back(n);
  scene.uvs.push_back(uv);
  return static_cast<uint32_t>(scene.positions.size() - 1);
}

inline void add_triangle(Scene& scene, uint32_t a, uint32_t b, uint32_t c, uint32_t material = 0) {
  Triangle triangle;
  triangle.v[0] = a, triangle.v[1] = b, triangle.v[2] = c;
  triangle.material = material;
  scene.triangles.push_back(triangle);
}

// Parallelogram corner, corner + a, corner + a + b, corner + b; normal along cross(a, b).
inline void add_quad(Scene& scene, const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b,
                     uint32_t material = 0) {
  const glm::vec3 n = glm::normalize(glm::cross(a, b));
  const uint32_t i = add_vertex(scene, corner, n, {0, 0});
  add_vertex(scene, corner + a, n, {1, 0});
  add_vertex(scene, corner + a + b, n, {1, 1});
  add_vertex(scene, corner + b, n, {0, 1});
  add_triangle(scene, i, i + 1, i + 2, material);
  add_triangle(scene, i, i + 2, i + 3, material);
}

// Axis-aligned box; normals point outwards (surfaces are two-sided anyway).
inline void add_box(Scene& scene, const glm::vec3& lo, const glm::vec3& hi, uint32_t material = 0) {
  const glm::vec3 d = hi - lo;
  const glm::vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  add_quad(scene, lo, y, x, material);
  add_quad(scene, lo + z, x, y, material);
  add_quad(scene, lo, x, z, material);
  add_quad(scene, lo + y, z, x, material);
  add_quad(scene, lo, z, y, material);
  add_quad(scene, lo + x, y, z, material);
}

// Latitude-longitude sphere of 2 n^2 quads with smooth outward normals.
inline void add_sphere(Scene& scene, const glm::vec3& centre, float radius, uint32_t n,
                       uint32_t material = 0) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j <= 2 * n; ++j) {
      const float theta = 3.14159265f * static_cast<float>(i) / static_cast<float>(n);
      const float phi = 3.14159265f * static_cast<float>(j) / static_cast<float>(n);
      const glm::vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      add_vertex(scene, centre + radius * d, d);
    }
  const uint32_t row = 2 * n + 1;
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < 2 * n; ++j) {
      const uint32_t a = first + i * row + j;
      if (i > 0) add_triangle(scene, a, a + 1, a + row, material);
      if (i + 1 < n) add_triangle(scene, a + 1, a + row + 1, a + row, material);
    }
}

inline Light omni(const glm::vec3& position, const glm::vec3& intensity = glm::vec3(1.0f)) {
  Light light;
  light.name = "omni";
  light.position = position;
  light.intensity = intensity;
  return light;
}

inline Light spot(const glm::vec3& position, const glm::vec3& direction, float inner_degrees,
                  float outer_degrees, const glm::vec3& intensity = glm::vec3(1.0f)) {
  Light light = omni(position, intensity);
  light.name = "spot";
  light.type = LightType::spot;
  light.direction = glm::normalize(direction);
  light.inner_degrees = inner_degrees;
  light.outer_degrees = outer_degrees;
  return light;
}

inline LightingState lighting(std::initializer_list<Light> lights) { return {"tiny", lights}; }

// An open box seen from its front side, with a block inside: interreflection, shadows and near corners. Side
// length `size`, centred at `centre`. Lambert unless `glossy`.
inline Scene room(float size = 2.0f, const glm::vec3& centre = glm::vec3(0.0f), bool glossy = false) {
  Scene scene = empty_scene(glm::vec3(0.7f));
  if (glossy) scene.materials[0].glossy = glm::vec3(0.25f), scene.materials[0].exponent = 12.0f;
  Material red = scene.materials[0], green = scene.materials[0];
  red.diffuse = {0.7f, 0.15f, 0.1f}, green.diffuse = {0.15f, 0.6f, 0.2f};
  const uint32_t left = add_material(scene, red), right = add_material(scene, green);
  const float s = size, h = 0.5f * size;
  const glm::vec3 lo = centre - glm::vec3(h), x(s, 0, 0), y(0, s, 0), z(0, 0, s);
  add_quad(scene, lo, z, x);      // floor
  add_quad(scene, lo + y, x, z);  // ceiling
  add_quad(scene, lo, x, y);      // back
  add_quad(scene, lo, y, z, left);
  add_quad(scene, lo + x, z, y, right);
  add_box(scene, lo + s * glm::vec3(0.2f, 0.0f, 0.2f), lo + s * glm::vec3(0.5f, 0.45f, 0.5f));
  // Off the axis: else the room's edges would pass through pixel centres, and rounding decide what is seen
  // there.
  scene.camera.eye = centre + s * glm::vec3(0.043f, 0.031f, 1.6f);
  scene.camera.target = centre + s * glm::vec3(0.017f, 0.0f, 0.0f);
  scene.camera.fov_y_degrees = 42.0f;
  finish_scene(scene);
  return scene;
}

}  // namespace relight::tiny
