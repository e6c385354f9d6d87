// Two-storey courtyard hall, 35 x 15 x 16: a court open to the sky, galleries with columns and round arches
// round it, outer walls, cloths hung in some arches. x in [-17.5,17.5], y in [0,15], z in [-8,8]; the kind of
// scene of Hasan et al. 2006 (Sponza), with their one sharp light on the floor.
#include <cmath>
#include <numbers>

#include "common/scene/builtin/builtin.h"
#include "common/scene/modelling/surfaces.h"

namespace relight {

namespace {

using modelling::Arcade;
using modelling::Frame;
using modelling::MeshBuilder;
using modelling::Profile;
using modelling::turned;

// Half extents of the court, heights of the storeys.
constexpr double court_x = 12.0, court_z = 4.0, bay = 4.0;
constexpr double slab_low = 6.4, slab_high = 7.0, roof_low = 13.2, roof_high = 13.7;

struct Palette {
  uint32_t stone, plaster, floor, ceiling, column, cloth_red, cloth_green, cloth_blue;
};

Palette add_materials(MeshBuilder& mesh) {
  return {mesh.material("stone", {0.62f, 0.54f, 0.42f}),
          mesh.material("plaster", {0.70f, 0.58f, 0.44f}),
          mesh.material("floor", {0.58f, 0.46f, 0.38f}),
          mesh.material("ceiling", {0.66f, 0.62f, 0.56f}),
          mesh.material("column", {0.72f, 0.68f, 0.60f}),
          mesh.material("red cloth", {0.62f, 0.12f, 0.10f}),
          mesh.material("green cloth", {0.18f, 0.42f, 0.16f}),
          mesh.material("blue cloth", {0.16f, 0.24f, 0.52f})};
}

void add_shell(MeshBuilder& mesh, const Palette& palette) {
  mesh.object("floor", palette.floor);
  mesh.box({-17.5, -0.5, -8.0}, {17.5, 0.0, 8.0}, 8);
  mesh.object("walls", palette.plaster);
  mesh.box({-17.5, 0.0, -8.0}, {17.5, 15.0, -7.5}, 8);
  mesh.box({-17.5, 0.0, 7.5}, {17.5, 15.0, 8.0}, 8);
  mesh.box({-17.5, 0.0, -7.5}, {-17.0, 15.0, 7.5}, 8);
  mesh.box({17.0, 0.0, -7.5}, {17.5, 15.0, 7.5}, 8);
}

// A storey's ring of slabs between the court and the walls, edge 0.3 outside the arcade's middle line.
void add_gallery(MeshBuilder& mesh, const std::string& name, uint32_t material, double low, double high) {
  const double x = court_x - 0.3, z = court_z - 0.3;
  mesh.object(name, material);
  mesh.box({-17.0, low, -7.5}, {17.0, high, -z}, 6);
  mesh.box({-17.0, low, z}, {17.0, high, 7.5}, 6);
  mesh.box({-17.0, low, -z}, {-x, high, z}, 6);
  mesh.box({x, low, -z}, {17.0, high, z}, 6);
}

void add_cornice(MeshBuilder& mesh, uint32_t material, double y) {
  mesh.object("cornice", material);
  const double x = court_x - 0.55, z = court_z - 0.55;
  mesh.box({-x, y, -z}, {x, y + 0.25, -z + 0.25}, 2);
  mesh.box({-x, y, z - 0.25}, {x, y + 0.25, z}, 2);
  mesh.box({-x, y, -z + 0.25}, {-x + 0.25, y + 0.25, z - 0.25}, 2);
  mesh.box({x - 0.25, y, -z + 0.25}, {x, y + 0.25, z - 0.25}, 2);
}

void append_torus(Profile& profile, double inner, double bulge, double low, double height, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double a = std::numbers::pi * i / steps;
    profile.emplace_back(inner + bulge * std::sin(a), low + height * 0.5 * (1.0 - std::cos(a)));
  }
}

// Attic base (two mouldings), shaft with entasis, echinus; `height` without plinth and abacus.
Profile column_profile(double radius, double height, int steps) {
  Profile profile = {{0.0, 0.0}};
  append_torus(profile, radius * 1.12, radius * 0.28, 0.0, 0.22, steps);
  append_torus(profile, radius * 1.06, radius * 0.16, 0.24, 0.14, steps);
  const double shaft_low = 0.42, shaft_high = height - 0.55;
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps;
    profile.emplace_back(radius * (1.0 - 0.15 * t * t), shaft_low + t * (shaft_high - shaft_low));
  }
  append_torus(profile, radius * 0.86, radius * 0.14, shaft_high + 0.04, 0.10, steps);
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps;
    profile.emplace_back(radius * (0.86 + 0.56 * t * t), shaft_high + 0.16 + 0.39 * t);
  }
  profile.emplace_back(0.0, height);
  return profile;
}

void add_column(MeshBuilder& mesh, const glm::dvec3& foot, double radius, double height, int sides,
                int steps) {
  const double w = radius * 1.45;
  mesh.box(turned(foot), {-w, 0.0, -w}, {w, 0.18, w});
  mesh.box(turned(foot), {-w, height - 0.18, -w}, {w, height, w});
  const Frame frame = turned(foot + glm::dvec3(0.0, 0.18, 0.0));
  modelling::lathe(mesh, frame, column_profile(radius, height - 0.36, steps), sides);
}

void add_storey(MeshBuilder& mesh, const Palette& palette, double floor, double spring, double top,
                double radius, int sides, int steps, int segments) {
  const double height = spring - floor;
  for (double z = -court_z; z <= court_z; z += bay)
    for (double x = -court_x; x <= court_x; x += bay) {
      const bool inside = std::abs(x) < court_x && std::abs(z) < court_z;
      if (inside) continue;
      mesh.object("column", palette.column);
      add_column(mesh, {x, floor, z}, radius, height, sides, steps);
    }
  // The long arcades reach round the corners; the short ones stand between them.
  const double thickness = 0.7, arch = 0.5 * bay - 0.45;
  for (const double side : {-1.0, 1.0}) {
    mesh.object("arcade", palette.stone);
    modelling::arcade(mesh, turned({0, 0, side * court_z}),
                      {2 * court_x + thickness, thickness, spring, top, arch, 6, segments, 0.5 * thickness});
    mesh.object("arcade", palette.stone);
    modelling::arcade(mesh, turned({side * court_x, 0, 0}, 90.0),
                      {2 * court_z - thickness, thickness, spring, top, arch - 0.2, 2, segments});
  }
}

// Cloth hung from the gallery rail, wavy; two-sided and thin.
void add_cloth(MeshBuilder& mesh, uint32_t material, const glm::dvec3& top_middle, double width, double drop,
               int cuts) {
  mesh.object("cloth", material);
  modelling::patch(mesh, cuts, cuts, [&](double s, double t) {
    const double fold = 0.12 * t * std::sin(2.0 * std::numbers::pi * (3.0 * s + 0.15 * t));
    const double sag = 0.25 * t * (1.0 - 4.0 * (s - 0.5) * (s - 0.5));
    return top_middle + glm::dvec3((s - 0.5) * width, -t * drop - sag, fold);
  });
}

void build(const BuiltinParameters& parameters, Scene& scene) {
  MeshBuilder mesh(scene);
  const double detail = parameters.real("detail");
  const auto count = [&](double n, int least) {
    return std::max(least, static_cast<int>(std::lround(n * detail)));
  };
  const Palette palette = add_materials(mesh);
  add_shell(mesh, palette);
  const int sides = count(20, 6), steps = count(6, 2), segments = count(24, 4);
  add_storey(mesh, palette, 0.0, 3.9, slab_low, 0.38, sides, steps, segments);
  add_gallery(mesh, "gallery", palette.ceiling, slab_low, slab_high);
  add_storey(mesh, palette, slab_high, 10.6, roof_low, 0.32, sides, steps, segments);
  add_gallery(mesh, "roof", palette.ceiling, roof_low, roof_high);
  add_cornice(mesh, palette.stone, slab_high - 0.15);
  add_cornice(mesh, palette.stone, roof_low - 0.3);
  const uint32_t cloths[3] = {palette.cloth_red, palette.cloth_green, palette.cloth_blue};
  for (int i = 0; i < 6; ++i) {
    const double x = -court_x + (i + 0.5) * bay;
    if (i % 2 == 0) add_cloth(mesh, cloths[(i / 2) % 3], {x, 10.4, -court_z}, 2.9, 3.0, count(20, 2));
    if (i % 2 == 1) add_cloth(mesh, cloths[(i / 2 + 1) % 3], {x, 10.4, court_z}, 2.9, 3.0, count(20, 2));
  }
  scene.camera = Camera{{-10.4f, 1.8f, 0.9f}, {4.0f, 4.6f, -0.6f}, {0, 1, 0}, 60.0f};
  // From the upper gallery across the court.
  scene.views["gallery"] = Camera{{-8.0f, 9.0f, 3.5f}, {5.0f, 3.0f, -2.0f}, {0, 1, 0}, 60.0f};
  scene.exposure = 1.0f;
  const glm::vec3 warm(1.0f, 0.95f, 0.85f);
  add_lighting(scene, "spot",
               {spot_light({1.5f, 14.0f, 0.5f}, {2.5f, 0.0f, -0.5f}, 5500.0f * warm, 18.0f, 20.0f)});
  add_lighting(scene, "spot2",
               {spot_light({6.0f, 14.5f, -1.0f}, {1.0f, 0.0f, 3.0f}, 5500.0f * warm, 18.0f, 20.0f)});
  add_lighting(scene, "omni", {omni_light({3.0f, 6.0f, 0.5f}, 150.0f * warm)});
}

}  // namespace

BuiltinGenerator colonnade_scene() {
  return {
      {"colonnade",
       "two-storey courtyard hall with columns, round arches, galleries and an open roof (66 k triangles)",
       {{"detail", 1, 0.1, 16,
         "scales the tessellation of columns, arches and cloths; triangles grow with its square"}}},
      build};
}

}  // namespace relight
