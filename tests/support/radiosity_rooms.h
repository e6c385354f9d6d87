// Cornell-type rooms, given once and turned both into a radiosity problem and into a scene for the path
// tracer.
#pragma once

#include "tests/support/radiosity.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {

struct Room {
  std::vector<Surface> surfaces;  // fronts face the inside
  std::optional<Block> block;

  Scene scene() const {
    Scene scene = tiny::empty_scene();
    for (const Surface& s : surfaces) {
      Material material;
      material.diffuse = glm::vec3(s.albedo), material.emission = glm::vec3(s.emission);
      tiny::add_quad(scene, glm::vec3(s.shape.corner), glm::vec3(s.shape.a), glm::vec3(s.shape.b),
                     tiny::add_material(scene, material));
    }
    finish_scene(scene);
    return scene;
  }
};

// Faces of the box lo..hi with normals inwards, in the order x = lo, x = hi, y = lo, y = hi, z = lo, z = hi.
inline std::vector<Rectangle> faces(const glm::dvec3& lo, const glm::dvec3& hi) {
  const glm::dvec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  return {{lo, y, z}, {lo + x, z, y}, {lo, z, x}, {lo + y, x, z}, {lo, x, y}, {lo + z, y, x}};
}
inline Rectangle turned_over(const Rectangle& r) { return {r.corner, r.b, r.a}; }

// The unit cube with a red, a green and grey walls. `lamp`: the middle of the ceiling, 2/3 x 2/3, shines with
// radiance (3, 2, 1). `block`: 1/3 x 1/2 x 1/3 on the floor, off the middle. All sides are multiples of 1/6.
inline Room cornell_room(bool lamp, bool block) {
  const glm::dvec3 red(0.6, 0.1, 0.08), green(0.15, 0.5, 0.12), grey(0.7, 0.68, 0.6);
  const std::vector<Rectangle> walls = faces(glm::dvec3(0.0), glm::dvec3(1.0));
  Room room;
  const glm::dvec3 albedo[6] = {red, green, grey, grey, grey, grey};
  for (size_t i = 0; i < 6; ++i)
    if (i != 3) room.surfaces.push_back({walls[i], albedo[i]});
  const double cut[4] = {0.0, 1.0 / 6.0, 5.0 / 6.0, 1.0};
  for (int i = 0; i < 9; ++i) {
    const int j = i % 3, k = i / 3;
    room.surfaces.push_back(
        {{{cut[j], 1.0, cut[k]}, {cut[j + 1] - cut[j], 0, 0}, {0, 0, cut[k + 1] - cut[k]}}, grey});
    if (lamp && i == 4) room.surfaces.back().emission = {3.0, 2.0, 1.0};
  }
  if (!block) return room;
  room.block = Block{{1.0 / 6.0, 0.0, 1.0 / 3.0}, {0.5, 0.5, 2.0 / 3.0}};
  const std::vector<Rectangle> sides = faces(room.block->lo, room.block->hi);
  for (size_t i = 0; i < 6; ++i)
    if (i != 2) room.surfaces.push_back({turned_over(sides[i]), grey});
  return room;
}

}  // namespace relight::check
