// Doric temple of 6 x 13 fluted columns, about 14 x 32 x 13, with steps, architrave, frieze, pediments, roof
// tiles and an inner cella with carved walls. Nothing is instanced: every column is generated anew. Long side
// along x.
#include <cmath>
#include <numbers>

#include "common/scene/builtin/builtin.h"
#include "common/scene/modelling/noise.h"
#include "common/scene/modelling/surfaces.h"

namespace relight {

namespace {

using modelling::Frame;
using modelling::MeshBuilder;
using modelling::Profile;
using modelling::turned;

constexpr int columns_x = 13, columns_z = 6;
constexpr double spacing = 2.4, column_height = 6.0, column_radius = 0.55;
constexpr double half_x = 0.5 * (columns_x - 1) * spacing, half_z = 0.5 * (columns_z - 1) * spacing;
constexpr double architrave = column_height, frieze = 6.8, cornice = 7.7, eaves = 8.0, ridge = 11.0;

struct Palette {
  uint32_t marble, floor, red, blue, tile, wall;
};

void add_ground_and_steps(MeshBuilder& mesh, const Palette& palette) {
  mesh.object("ground", mesh.material("ground", {0.40f, 0.36f, 0.26f}));
  mesh.box({-40, -1.8, -40}, {40, -1.2, 40}, 64);
  for (int i = 0; i < 3; ++i) {
    const double reach = 0.9 + 0.45 * (2 - i), low = -1.2 + 0.4 * i;
    mesh.object("step", palette.floor);
    mesh.box({-half_x - reach, low, -half_z - reach}, {half_x + reach, low + 0.4, half_z + reach}, 32);
  }
}

// 20 flutes with sharp arrises, shallower towards the top.
double doric_flute(double angle, double) {
  const double phase = std::fmod(angle * 20.0 / (2.0 * std::numbers::pi), 1.0);
  return 1.0 - 0.055 * std::sin(std::numbers::pi * phase);
}

void add_column(MeshBuilder& mesh, const Palette& palette, const glm::dvec3& foot, double r, int sides,
                int rows) {
  const double shaft = column_height - 0.62;
  Profile profile;
  for (int j = 0; j <= rows; ++j) {
    const double t = double(j) / rows;
    profile.emplace_back(r * (1.0 - 0.22 * t + 0.06 * std::sin(std::numbers::pi * t)), shaft * t);
  }
  mesh.object("column", palette.marble);
  modelling::fluted_lathe(mesh, turned(foot), profile, sides, doric_flute);
  Profile capital = {{0.0, 0.0}};
  for (int j = 0; j <= 12; ++j) {
    const double t = j / 12.0;
    capital.emplace_back(r * (0.79 + 0.45 * std::sqrt(t)), 0.34 * t);
  }
  capital.emplace_back(0.0, 0.34);
  modelling::lathe(mesh, turned(foot + glm::dvec3(0, shaft, 0)), capital, sides / 4);
  const double w = 1.3 * r;
  mesh.box(turned(foot), {-w, shaft + 0.34, -w}, {w, column_height, w}, 2);
}

void add_columns(MeshBuilder& mesh, const Palette& palette, int sides, int rows) {
  for (int k = 0; k < columns_z; ++k)
    for (int i = 0; i < columns_x; ++i) {
      if (i > 0 && i + 1 < columns_x && k > 0 && k + 1 < columns_z) continue;
      add_column(mesh, palette, {-half_x + i * spacing, 0.0, -half_z + k * spacing}, column_radius, sides,
                 rows);
    }
  // Two rows of slighter columns in the cella.
  for (const double z : {-1.7, 1.7})
    for (int i = 0; i < 7; ++i) add_column(mesh, palette, {-8.4 + 2.8 * i, 0.0, z}, 0.3, sides / 2, rows / 2);
}

// Rectangular ring of beams over the columns: outer and inner half extents about the column axes.
void add_ring(MeshBuilder& mesh, const std::string& name, uint32_t material, double out, double in,
              double low, double high) {
  mesh.object(name, material);
  mesh.box({-half_x - out, low, -half_z - out}, {half_x + out, high, -half_z + in}, 16);
  mesh.box({-half_x - out, low, half_z - in}, {half_x + out, high, half_z + out}, 16);
  mesh.box({-half_x - out, low, -half_z + in}, {-half_x + in, high, half_z - in}, 16);
  mesh.box({half_x - in, low, -half_z + in}, {half_x + out, high, half_z - in}, 16);
}

// A triglyph (three bars) over each column and each gap, all round.
void add_triglyphs(MeshBuilder& mesh, const Palette& palette) {
  const auto place = [&](const glm::dvec3& at, double degrees) {
    mesh.object("triglyph", palette.blue);
    for (const double x : {-0.17, 0.0, 0.17})
      mesh.box(turned(at, degrees), {x - 0.06, frieze + 0.02, 0.0}, {x + 0.06, cornice - 0.02, 0.08});
  };
  const double face = 0.5;
  for (int i = 0; i < 2 * columns_x - 1; ++i) {
    const double x = -half_x + 0.5 * i * spacing;
    place({x, 0, half_z + face}, 0.0);
    place({x, 0, -half_z - face}, 180.0);
  }
  for (int k = 0; k < 2 * columns_z - 1; ++k) {
    const double z = -half_z + 0.5 * k * spacing;
    place({half_x + face, 0, z}, 90.0);
    place({-half_x - face, 0, z}, -90.0);
  }
}

// Triangular end wall, closed prism.
void add_pediment(MeshBuilder& mesh, uint32_t material, double x0, double x1) {
  mesh.object("pediment", material);
  const double w = half_z + 0.5;
  const glm::dvec3 a0(x0, eaves, -w), b0(x0, eaves, w), c0(x0, ridge - 0.15, 0);
  const glm::dvec3 a1(x1, eaves, -w), b1(x1, eaves, w), c1(x1, ridge - 0.15, 0);
  const auto flat = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    mesh.triangle(mesh.vertex(a, n), mesh.vertex(b, n), mesh.vertex(c, n));
  };
  flat(a0, b0, c0);
  flat(a1, c1, b1);
  mesh.face(a0, a1, b1, b0);
  mesh.face(b0, b1, c1, c0);
  mesh.face(a1, a0, c0, c1);
}

// One corrugated slope of the roof, from the eaves to the ridge, with a real thickness.
void add_roof(MeshBuilder& mesh, const Palette& palette, int cells) {
  const double w = half_z + 1.0, length = 2.0 * (half_x + 1.0), slope = std::hypot(w, ridge - eaves);
  const auto tiles = [](double s, double t) {
    const double across = std::abs(std::sin(std::numbers::pi * 64.0 * s));
    const double row = std::fmod(16.0 * t, 1.0);
    return 0.06 * across + 0.05 * (1.0 - row);
  };
  for (const double side : {1.0, -1.0}) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(0, ridge - eaves, -side * w));
    const glm::dvec3 along(side, 0, 0);
    const Frame frame{glm::dvec3(-side * 0.5 * length, eaves, side * w),
                      glm::dmat3(along, up, glm::cross(along, up))};
    mesh.object("roof", palette.tile);
    modelling::relief_panel(mesh, frame, {length, slope, 0.1}, cells, cells / 2, tiles);
  }
}

// Walls of the inner room, carved on both long faces and inside the back wall; open towards +x.
void add_cella(MeshBuilder& mesh, const Palette& palette, int cells, uint64_t seed) {
  const double x = half_x - 2.6, z = half_z - 2.6, height = 6.6;
  const auto carving = [seed](double s, double t) {
    const double band = std::exp(-60.0 * (t - 0.62) * (t - 0.62));
    const double figures = modelling::fractal_noise(40.0 * s, 9.0 * t, 5, seed);
    const double joints = std::min(std::abs(std::sin(std::numbers::pi * 12.0 * s)),
                                   std::abs(std::sin(std::numbers::pi * 8.0 * t)));
    return 0.22 * band * figures + 0.02 * std::min(1.0, 12.0 * joints);
  };
  const auto wall = [&](const char* name, const glm::dvec3& corner, double degrees, double width) {
    mesh.object(name, palette.wall);
    modelling::relief_panel(mesh, turned(corner, degrees), {width, height, 0.3}, cells, cells / 2, carving);
  };
  wall("cella wall north", {-x, 0, z}, 0.0, 2 * x);
  wall("cella wall south", {x, 0, -z}, 180.0, 2 * x);
  wall("cella wall back", {-x, 0, z}, 90.0, 2 * z);
  mesh.object("ceiling", palette.red);
  mesh.box({-half_x, 6.6, -half_z}, {half_x, 6.8, half_z}, 32);
}

void build(const BuiltinParameters& parameters, Scene& scene) {
  MeshBuilder mesh(scene);
  const double detail = parameters.real("detail");
  const auto count = [&](double n, int least) {
    return std::max(least, static_cast<int>(std::lround(n * detail)));
  };
  const Palette palette = {mesh.material("marble", {0.74f, 0.70f, 0.62f}),
                           mesh.material("floor", {0.58f, 0.53f, 0.46f}),
                           mesh.material("red paint", {0.58f, 0.20f, 0.14f}),
                           mesh.material("blue paint", {0.18f, 0.28f, 0.52f}),
                           mesh.material("roof tiles", {0.60f, 0.34f, 0.22f}),
                           mesh.material("carved wall", {0.70f, 0.60f, 0.44f})};
  scene.positions.reserve(static_cast<size_t>(1.3e6 * detail * detail));
  scene.triangles.reserve(static_cast<size_t>(2.3e6 * detail * detail));
  add_ground_and_steps(mesh, palette);
  // A multiple of the 20 flutes, so that every arris lies on a vertex.
  add_columns(mesh, palette, 40 * count(6, 2), count(84, 4));
  add_ring(mesh, "architrave", palette.marble, 0.45, 0.45, architrave, frieze);
  add_ring(mesh, "frieze", palette.red, 0.5, 0.5, frieze, cornice);
  add_ring(mesh, "cornice", palette.marble, 0.9, 0.5, cornice, eaves);
  add_triglyphs(mesh, palette);
  add_pediment(mesh, palette.blue, -half_x - 0.5, -half_x + 0.2);
  add_pediment(mesh, palette.blue, half_x - 0.2, half_x + 0.5);
  add_roof(mesh, palette, count(260, 16));
  add_cella(mesh, palette, count(340, 16), parameters.seed());
  // From the depth of the cella towards the front columns, at eye height beside an inner row.
  scene.camera = Camera{{-10.9f, 1.9f, 0.6f}, {6.0f, 2.7f, -0.7f}, {0, 1, 0}, 70.0f};
  scene.exposure = 1.0f;
  const glm::vec3 warm(1.0f, 0.93f, 0.82f);
  add_lighting(scene, "spot",
               {spot_light({-2.0f, 6.3f, 0.1f}, {-1.6f, 0.0f, -0.3f}, 2000.0f * warm, 18.0f, 20.0f)});
  add_lighting(scene, "omni", {omni_light({-3.0f, 4.6f, 0.0f}, 30.0f * warm)});
}

}  // namespace

BuiltinGenerator temple_scene() {
  return {
      {"temple",
       "Doric temple, nothing instanced: fluted columns, frieze, tiled roof, carved cella (2.1 M triangles)",
       {{"detail", 1, 0.1, 4, "scales all tessellation; triangles grow with its square"},
        {"seed", 1, 0, 1e6, "changes the carving"}}},
      build};
}

}  // namespace relight
