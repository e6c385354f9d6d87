// Still life: a table in a corner of a room with diffuse and glossy vases and spheres, a carved relief
// (displaced geometry), and a plant with thin two-sided leaves. About 2 m across, y up, table top at y =
// 0.75.
#include <cmath>
#include <numbers>

#include "common/sampling/random.h"
#include "common/scene/builtin/builtin.h"
#include "common/scene/modelling/noise.h"
#include "common/scene/modelling/surfaces.h"

namespace relight {

namespace {

using modelling::MeshBuilder;
using modelling::Profile;
using modelling::turned;

constexpr double table_top = 0.75;

// Glazed tiles: two colours that vary from tile to tile, with darker joints.
Texture tile_texture(uint64_t seed) {
  constexpr int tiles = 8, texels = 32;
  Texture texture;
  texture.file = "procedural tiles";
  texture.width = texture.height = tiles * texels;
  for (int y = 0; y < texture.height; ++y)
    for (int x = 0; x < texture.width; ++x) {
      const int tx = x / texels, ty = y / texels;
      const bool joint = x % texels < 2 || y % texels < 2;
      const float shade =
          0.85f + 0.3f * random_float(seed, 1, static_cast<uint64_t>(tx), static_cast<uint64_t>(ty));
      const glm::vec3 colour =
          (tx + ty) % 2 ? glm::vec3(0.62f, 0.55f, 0.42f) : glm::vec3(0.30f, 0.42f, 0.50f);
      texture.texels.push_back(joint ? glm::vec3(0.25f) : colour * shade);
    }
  return texture;
}

void add_room(MeshBuilder& mesh, uint64_t seed) {
  const uint32_t tiles = mesh.material("tiles", glm::vec3(1.0f));
  mesh.scene().materials[tiles].diffuse_texture = static_cast<int>(mesh.add_texture(tile_texture(seed)));
  mesh.object("floor", mesh.material("floorboards", {0.45f, 0.32f, 0.22f}));
  mesh.face({-2, 0, 2}, {2, 0, 2}, {2, 0, -1.5}, {-2, 0, -1.5}, 4, 4);
  mesh.object("back wall", tiles);
  mesh.face({-2, 0, -1.5}, {2, 0, -1.5}, {2, 3, -1.5}, {-2, 3, -1.5}, 4, 4);
  mesh.object("left wall", mesh.material("ochre wall", {0.72f, 0.52f, 0.28f}));
  mesh.face({-2, 0, 2}, {-2, 0, -1.5}, {-2, 3, -1.5}, {-2, 3, 2}, 4, 4);
  mesh.object("right wall", mesh.material("pale wall", {0.66f, 0.68f, 0.70f}));
  mesh.face({2, 0, -1.5}, {2, 0, 2}, {2, 3, 2}, {2, 3, -1.5}, 4, 4);
  mesh.object("ceiling", mesh.material("ceiling", {0.75f, 0.74f, 0.72f}));
  mesh.face({-2, 3, -1.5}, {2, 3, -1.5}, {2, 3, 2}, {-2, 3, 2}, 4, 4);
}

void add_table(MeshBuilder& mesh, int sides) {
  const uint32_t wood = mesh.material("table", {0.48f, 0.30f, 0.18f}, {0.06f, 0.06f, 0.06f}, 40.0f);
  mesh.object("table top", wood);
  mesh.box({-1.1, table_top - 0.05, -0.75}, {1.1, table_top, 0.75}, 8);
  const Profile leg = {{0, 0},       {0.03, 0},    {0.035, 0.1}, {0.05, 0.2},
                       {0.035, 0.3}, {0.045, 0.6}, {0.05, 0.7},  {0, 0.7}};
  for (const double x : {-1.0, 1.0})
    for (const double z : {-0.65, 0.65}) {
      mesh.object("table leg", wood);
      modelling::lathe(mesh, turned({x, 0, z}), leg, sides);
    }
}

// A vessel with a wall: outside up, over the lip, inside down. `swing` shapes the belly.
Profile vase_profile(double height, double foot, double belly, double neck, int rows) {
  const auto radius = [&](double t) {
    const double body = std::sin(std::numbers::pi * std::pow(t, 0.75));
    return glm::mix(foot, neck, t) + (belly - 0.5 * (foot + neck)) * body;
  };
  const double wall = 0.08 * belly;
  Profile profile = {{0.0, 0.0}};
  for (int j = 0; j <= rows; ++j) profile.emplace_back(radius(double(j) / rows), height * j / rows);
  for (int j = rows; j >= 1; --j)
    profile.emplace_back(radius(double(j) / rows) - wall, height * (j - 0.3) / rows);
  profile.emplace_back(0.0, height * 0.7 / rows);
  return profile;
}

void add_vessels(MeshBuilder& mesh, int sides, int rows) {
  const auto vase = [&](const char* name, uint32_t material, const glm::dvec3& foot, const Profile& profile) {
    mesh.object(name, material);
    modelling::lathe(mesh, turned(foot), profile, sides);
  };
  vase("tall vase", mesh.material("blue glaze", {0.10f, 0.18f, 0.38f}, {0.30f, 0.30f, 0.32f}, 120.0f),
       {-0.55, table_top, -0.25}, vase_profile(0.62, 0.09, 0.17, 0.06, rows));
  vase("clay vase", mesh.material("clay", {0.62f, 0.32f, 0.20f}), {-0.18, table_top, -0.42},
       vase_profile(0.42, 0.08, 0.15, 0.09, rows));
  vase("bronze bowl", mesh.material("bronze", {0.10f, 0.07f, 0.04f}, {0.60f, 0.42f, 0.22f}, 50.0f),
       {0.10, table_top, 0.28}, vase_profile(0.14, 0.08, 0.16, 0.22, rows));
  const auto ball = [&](const char* name, uint32_t material, const glm::dvec3& at, double radius) {
    mesh.object(name, material);
    modelling::sphere(mesh, turned(at + glm::dvec3(0, radius, 0)), radius, sides, sides / 2);
  };
  ball("orange", mesh.material("orange", {0.70f, 0.34f, 0.06f}, {0.05f, 0.05f, 0.05f}, 20.0f),
       {-0.35, table_top, 0.30}, 0.075);
  ball("steel ball", mesh.material("steel", {0.05f, 0.05f, 0.05f}, {0.62f, 0.62f, 0.62f}, 200.0f),
       {0.52, table_top, 0.36}, 0.11);
  ball("chalk ball", mesh.material("chalk", {0.76f, 0.75f, 0.72f}), {-0.62, table_top, 0.20}, 0.10);
}

// A carved panel leaning against nothing but its own foot: rosette, rays and a grainy ground.
void add_relief(MeshBuilder& mesh, int cells, uint64_t seed) {
  mesh.object("relief", mesh.material("sandstone", {0.66f, 0.56f, 0.40f}));
  const auto relief = [seed](double s, double t) {
    const double x = 2.0 * s - 1.0, y = 2.0 * t - 1.0, r = std::hypot(x, y), a = std::atan2(y, x);
    const double petals = std::exp(-12.0 * (r - 0.45) * (r - 0.45)) * (0.6 + 0.4 * std::cos(10.0 * a));
    const double boss = 0.8 * std::exp(-40.0 * r * r);
    const double frame = std::max(std::abs(x), std::abs(y)) > 0.88 ? 0.7 : 0.0;
    return 0.035 * (petals + boss + frame) + 0.012 * modelling::fractal_noise(24.0 * s, 24.0 * t, 4, seed);
  };
  modelling::relief_panel(mesh, turned({0.12, table_top, -0.52}, -14.0), {0.72, 0.62, 0.06}, cells, cells,
                          relief);
}

void add_plant(MeshBuilder& mesh, int stems, int leaves, int cuts, int sides, uint64_t seed) {
  const glm::dvec3 foot(0.86, table_top, -0.05);
  mesh.object("pot", mesh.material("pot", {0.34f, 0.50f, 0.44f}, {0.10f, 0.10f, 0.10f}, 80.0f));
  modelling::lathe(mesh, turned(foot), vase_profile(0.2, 0.09, 0.12, 0.13, 12), sides);
  const uint32_t stem_material = mesh.material("stem", {0.30f, 0.36f, 0.14f});
  const uint32_t leaf_material = mesh.material("leaf", {0.22f, 0.46f, 0.12f}, {0.06f, 0.07f, 0.05f}, 30.0f);
  for (int k = 0; k < stems; ++k) {
    const auto number = [&](uint64_t dimension) {
      return double(random_float(seed, 2, static_cast<uint64_t>(k), dimension));
    };
    const double turn = 2.0 * std::numbers::pi * (k + 0.6 * number(0)) / stems;
    const double height = 0.45 + 0.35 * number(1), lean = 0.12 + 0.16 * number(2);
    std::vector<glm::dvec3> curve;
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0;
      curve.push_back(foot + glm::dvec3((0.03 + lean * t * t) * std::cos(turn), 0.03 + height * t,
                                        (0.03 + lean * t * t) * std::sin(turn)));
    }
    mesh.object("stem", stem_material);
    modelling::tube(mesh, curve, 0.008, 0.003, 8);
    mesh.object("leaves", leaf_material);
    for (int i = 0; i < leaves; ++i) {
      const double t = 0.35 + 0.65 * (i + 1.0) / leaves;
      const auto at = static_cast<size_t>(std::lround(16.0 * t));
      const double a = turn + 2.4 * i, length = 0.16 + 0.08 * number(3 + static_cast<uint64_t>(i));
      const glm::dvec3 along(length * std::cos(a), 0.45 * length, length * std::sin(a));
      modelling::leaf(mesh, curve[at], along, 0.4 * length, 0.45, cuts);
    }
  }
}

void build(const BuiltinParameters& parameters, Scene& scene) {
  MeshBuilder mesh(scene);
  const double detail = parameters.real("detail");
  const auto count = [&](double n, int least) {
    return std::max(least, static_cast<int>(std::lround(n * detail)));
  };
  const uint64_t seed = parameters.seed();
  add_room(mesh, seed);
  add_table(mesh, count(32, 6));
  add_vessels(mesh, count(68, 8), count(40, 4));
  add_relief(mesh, count(100, 8), seed);
  add_plant(mesh, 12, 8, count(8, 2), count(48, 8), seed);
  scene.camera = Camera{{-0.15f, 1.45f, 2.15f}, {0.12f, 0.92f, -0.2f}, {0, 1, 0}, 42.0f};
  scene.exposure = 1.0f;
  const glm::vec3 warm(1.0f, 0.93f, 0.82f);
  add_lighting(scene, "spot",
               {spot_light({-1.3f, 2.7f, 1.2f}, {0.2f, 0.8f, -0.3f}, 36.0f * warm, 26.0f, 32.0f)});
  add_lighting(scene, "omni", {omni_light({-1.1f, 2.3f, 1.1f}, 6.0f * warm)});
  add_lighting(scene, "two",
               {omni_light({-1.4f, 2.4f, 0.8f}, 4.0f * warm),
                spot_light({1.4f, 2.6f, 1.4f}, {0.2f, 0.8f, 0.0f}, glm::vec3(8, 9, 11), 15.0f, 22.0f)});
}

}  // namespace

BuiltinGenerator still_life_scene() {
  return {
      {"still_life",
       "table with diffuse and glossy vases and balls, a carved relief and a plant (about 100 k triangles)",
       {{"detail", 1, 0.1, 8, "scales all tessellation; triangles grow with its square"},
        {"seed", 1, 0, 1e6, "changes stone grain, tiles and plant"}}},
      build};
}

}  // namespace relight
