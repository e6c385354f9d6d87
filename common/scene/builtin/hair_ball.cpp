// A ball of curved thin tubes on a plinth in a simple room: visibility at its worst. Ball of radius 1 about
// (0, 1.6, 0).
#include <cmath>
#include <numbers>

#include "common/sampling/random.h"
#include "common/scene/builtin/builtin.h"
#include "common/scene/modelling/surfaces.h"

namespace relight {

namespace {

using modelling::MeshBuilder;
using modelling::turned;

void add_room(MeshBuilder& mesh) {
  const uint32_t wall = mesh.material("wall", {0.68f, 0.64f, 0.58f});
  mesh.object("floor", mesh.material("floor", {0.52f, 0.46f, 0.40f}));
  mesh.face({-4, 0, 4}, {4, 0, 4}, {4, 0, -3}, {-4, 0, -3}, 8, 8);
  mesh.object("back", wall);
  mesh.face({-4, 0, -3}, {4, 0, -3}, {4, 5, -3}, {-4, 5, -3}, 8, 8);
  mesh.object("left", mesh.material("rust wall", {0.62f, 0.28f, 0.16f}));
  mesh.face({-4, 0, 4}, {-4, 0, -3}, {-4, 5, -3}, {-4, 5, 4}, 8, 8);
  mesh.object("right", mesh.material("teal wall", {0.18f, 0.46f, 0.48f}));
  mesh.face({4, 0, -3}, {4, 0, 4}, {4, 5, 4}, {4, 5, -3}, 8, 8);
  mesh.object("plinth", wall);
  modelling::lathe(mesh, turned({0, 0, 0}), {{0, 0}, {0.9, 0}, {0.9, 0.1}, {0.7, 0.2}, {0.7, 0.5}, {0, 0.5}},
                   64);
}

// A strand leaves the core at a random direction and wanders: its direction is bent towards a slowly turning
// random axis, which makes curls of about the ball's size.
std::vector<glm::dvec3> strand(uint64_t seed, uint64_t index, const glm::dvec3& centre, int segments) {
  const auto number = [&](uint64_t dimension) { return double(random_float(seed, 3, index, dimension)); };
  const auto direction = [&](uint64_t dimension) {
    const double y = 2.0 * number(dimension) - 1.0, a = 2.0 * std::numbers::pi * number(dimension + 1);
    const double r = std::sqrt(std::max(0.0, 1.0 - y * y));
    return glm::dvec3(r * std::cos(a), y, r * std::sin(a));
  };
  const glm::dvec3 out = direction(0), axis = direction(2);
  const double length = 0.55 + 0.45 * number(4), curl = 2.0 + 4.0 * number(5);
  glm::dvec3 p = centre + 0.45 * out, heading = out;
  std::vector<glm::dvec3> curve = {p};
  for (int i = 0; i < segments; ++i) {
    heading = glm::normalize(heading + (curl / segments) * glm::cross(axis, heading));
    // Beyond the ball's surface strands turn inwards, so that the ball stays a ball.
    const glm::dvec3 radial = p - centre;
    const double excess = glm::length(radial) - 0.9;
    if (excess > 0.0) heading = glm::normalize(heading - 4.0 * excess * glm::normalize(radial));
    p += heading * (length / segments);
    curve.push_back(p);
  }
  return curve;
}

void build(const BuiltinParameters& parameters, Scene& scene) {
  MeshBuilder mesh(scene);
  add_room(mesh);
  const glm::dvec3 centre(0.0, 1.5, 0.0);
  mesh.object("core", mesh.material("core", {0.35f, 0.26f, 0.18f}));
  modelling::sphere(mesh, turned(centre), 0.46, 64, 32);
  const uint32_t colours[3] = {
      mesh.material("dark hair", {0.36f, 0.22f, 0.12f}, {0.05f, 0.05f, 0.05f}, 30.0f),
      mesh.material("fair hair", {0.66f, 0.50f, 0.28f}, {0.05f, 0.05f, 0.05f}, 30.0f),
      mesh.material("red hair", {0.60f, 0.26f, 0.12f}, {0.05f, 0.05f, 0.05f}, 30.0f)};
  const int strands = parameters.whole("strands"), segments = parameters.whole("segments");
  const int sides = parameters.whole("sides");
  const double thickness = parameters.real("thickness");
  for (int i = 0; i < strands; ++i) {
    const uint64_t index = static_cast<uint64_t>(i);
    mesh.object("strand", colours[random_bits(parameters.seed(), 4, index, 0) % 3]);
    modelling::tube(mesh, strand(parameters.seed(), index, centre, segments), thickness, 0.4 * thickness,
                    sides);
  }
  scene.camera = Camera{{0.6f, 2.1f, 5.2f}, {0, 1.5f, 0}, {0, 1, 0}, 40.0f};
  scene.exposure = 1.0f;
  const glm::vec3 warm(1.0f, 0.94f, 0.84f);
  add_lighting(scene, "spot", {spot_light({-2.2f, 4.6f, 2.4f}, {0, 1.3f, 0}, 170.0f * warm, 24.0f, 30.0f)});
  add_lighting(scene, "omni", {omni_light({-2.0f, 3.8f, 2.2f}, 45.0f * warm)});
}

}  // namespace

BuiltinGenerator hair_ball_scene() {
  return {{"hair_ball",
           "ball of curved thin tubes in a simple room (about 320 k triangles)",
           {{"strands", 2970, 1, 100000, "number of tubes"},
            {"segments", 10, 2, 256, "segments along a tube"},
            {"sides", 5, 3, 32, "sides of a tube"},
            {"thickness", 0.006, 0.0005, 0.05, "radius of a tube at its root [scene units]"},
            {"seed", 1, 0, 1e6, "changes all strands"}}},
          build};
}

}  // namespace relight
