// Cornell box: 2 x 2 x 2 with two boxes; x in [-1,1], y in [0,2], z in [-1,1], front at z = 1.
#include <algorithm>

#include "common/scene/builtin/builtin.h"
#include "common/scene/modelling/mesh_builder.h"

namespace relight {

namespace {

using modelling::MeshBuilder;

// The room's walls are single faces seen from inside, as in a room cut out of a solid block.
void add_room(MeshBuilder& mesh, bool open_front, int cuts) {
  const uint32_t white = mesh.material("white", {0.72f, 0.71f, 0.68f});
  const uint32_t red = mesh.material("red", {0.63f, 0.10f, 0.08f});
  const uint32_t green = mesh.material("green", {0.16f, 0.48f, 0.12f});
  mesh.object("floor", white);
  mesh.face({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, cuts, cuts);
  mesh.object("ceiling", white);
  mesh.face({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, cuts, cuts);
  mesh.object("back", white);
  mesh.face({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, cuts, cuts);
  mesh.object("left", red);
  mesh.face({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, cuts, cuts);
  mesh.object("right", green);
  mesh.face({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, cuts, cuts);
  if (open_front) return;
  mesh.object("front", white);
  mesh.face({1, 0, 1}, {-1, 0, 1}, {-1, 2, 1}, {1, 2, 1}, cuts, cuts);
}

void build(const BuiltinParameters& parameters, Scene& scene) {
  MeshBuilder mesh(scene);
  const bool open_front = parameters.whole("open_front") != 0;
  const int cuts = parameters.whole("detail");
  add_room(mesh, open_front, cuts);
  const int boxes = parameters.whole("boxes");
  if (boxes >= 1) {
    mesh.object("tall box", mesh.material("pale", {0.70f, 0.66f, 0.52f}));
    mesh.box(modelling::turned({-0.33, 0.0, -0.30}, 18.0), {-0.30, 0.0, -0.30}, {0.30, 1.2, 0.30}, cuts);
  }
  if (boxes >= 2) {
    mesh.object("short box", mesh.material("blue grey", {0.45f, 0.52f, 0.65f}));
    mesh.box(modelling::turned({0.36, 0.0, 0.32}, -17.0), {-0.30, 0.0, -0.30}, {0.30, 0.6, 0.30}, cuts);
  }
  // Off the axis by a little: else the edges of walls and ceiling would pass exactly through pixel centres,
  // and rounding, which differs between processors, decide what is seen there. A closed room is seen from
  // inside it, with a wider view.
  scene.camera = open_front ? Camera{{0.011f, 1.007f, 3.9f}, {0.004f, 1.003f, 0}, {0, 1, 0}, 39.0f}
                            : Camera{{0, 1.05f, 0.97f}, {0, 0.9f, -1}, {0, 1, 0}, 75.0f};
  scene.exposure = 1.0f;
  add_lighting(scene, "omni", {omni_light({0.0f, 1.75f, 0.2f}, glm::vec3(1.3f, 1.2f, 1.05f))});
  add_lighting(
      scene, "spot",
      {spot_light({0.0f, 1.9f, 0.3f}, {-0.45f, 0.0f, 0.6f}, glm::vec3(80.0f, 74.0f, 64.0f), 18.0f, 20.0f)});
  // 0.03 from two walls and the floor: 1/r^2 reaches 1100 there.
  add_lighting(scene, "near", {omni_light({0.97f, 0.03f, -0.97f}, glm::vec3(2.5f, 2.4f, 2.2f))});
}

}  // namespace

BuiltinGenerator cornell_scene() {
  return {
      {"cornell",
       "Cornell box of 2 x 2 x 2 with two boxes; preset 'near' holds a light 0.03 from a corner",
       {{"boxes", 2, 0, 2, "number of boxes in the room"},
        {"open_front", 1, 0, 1, "1: the front wall is missing; 0: the room is closed and seen from inside"},
        {"detail", 1, 1, 512, "each face is cut into detail x detail quads"}}},
      build};
}

}  // namespace relight
