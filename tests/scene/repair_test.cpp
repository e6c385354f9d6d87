// The checker itself, on hand-made meshes and on the built-in scenes, which must pass it untouched.
#include <cmath>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/scene/mesh_repair.h"
#include "common/scene/scene_file.h"
#include "common/scene/topology.h"
#include "common/scene/validation.h"

namespace relight {
namespace {

// Red if a generator leaves anything that a file would be repaired for.
TEST(BuiltinScenes, NeedNoRepair) {
  for (const char* name : {"cornell:detail=3", "colonnade:detail=0.3", "still_life:detail=0.3",
                           "hair_ball:strands=50,segments=5", "temple:detail=0.1"}) {
    Scene scene = load_scene(name);
    const size_t triangles = scene.triangles.size();
    repair_scene(scene);
    for (const auto& [what, count] : scene.repairs.counts)
      ADD_FAILURE() << name << ": " << what << " " << count;
    EXPECT_EQ(scene.triangles.size(), triangles);
  }
}

Scene two_triangles() {
  Scene scene;
  scene.name = "two triangles";
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  scene.normals.assign(4, {0, 0, 1});
  scene.uvs.assign(4, {0, 0});
  scene.triangles = {{{0, 1, 2}, 0, 0}, {{1, 3, 2}, 0, 0}};
  scene.materials.resize(1);
  scene.object_names = {"sheet"};
  return scene;
}

// Red if an absolute epsilon decides what has no area: a sound mesh of 1e-6 or 1e6 units is kept.
TEST(TriangleFaults, DoNotDependOnTheScaleOrTheDistanceFromTheOrigin) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    Scene scene = two_triangles();
    for (glm::vec3& p : scene.positions) p = (p + glm::vec3(3, 4, 5)) * scale;
    for (const TriangleFault fault : find_triangle_faults(scene.positions, scene.triangles))
      EXPECT_EQ(fault, TriangleFault::none) << scale;
  }
}

// Red if exact collinearity off the axes is missed because the rounded cross product is not zero.
TEST(TriangleFaults, FindCollinearCornersExactly) {
  // v, 3 v and 2^20 v are exact in single precision, their differences are not.
  const glm::vec3 v(1398101.0f, 2097143.0f, 3000001.0f);
  const std::vector<glm::vec3> positions = {v, 3.0f * v, 1048576.0f * v,
                                            1048576.0f * glm::vec3(v.x, v.z, v.y)};
  const glm::vec3 rounded = glm::cross(positions[1] - positions[0], positions[2] - positions[0]);
  ASSERT_NE(rounded, glm::vec3(0.0f)) << "the example no longer shows the difference";
  const std::vector<Triangle> triangles = {{{0, 1, 2}, 0, 0}, {{0, 1, 3}, 0, 0}, {{0, 0, 3}, 0, 0}};
  const auto faults = find_triangle_faults(positions, triangles);
  EXPECT_EQ(faults[0], TriangleFault::zero_area);
  EXPECT_EQ(faults[1], TriangleFault::none);
  EXPECT_EQ(faults[2], TriangleFault::zero_area);
}

// Red if duplicates are found by index only, or a vertex is merged across different normals.
TEST(TriangleFaults, FindDuplicatesByPositionAndKeepTheFirst) {
  Scene scene = two_triangles();
  for (const int v : {2, 1, 0}) {
    scene.positions.push_back(scene.positions[static_cast<size_t>(v)]);
    scene.normals.push_back({0, 0, -1});
    scene.uvs.push_back({0, 0});
  }
  scene.triangles.push_back({{4, 5, 6}, 0, 0});
  const auto faults = find_triangle_faults(scene.positions, scene.triangles);
  EXPECT_EQ(faults[0], TriangleFault::none);
  EXPECT_EQ(faults[1], TriangleFault::none);
  EXPECT_EQ(faults[2], TriangleFault::duplicate);
  scene.triangles.erase(scene.triangles.begin());  // now the copy is the only one: both normals stay
  repair_scene(scene);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.positions.size(), 6u);
}

// Red if: the bound is absolute, or compares with the distance of the centre only.
TEST(Repair, WarnsOfASceneTooFarFromTheOriginForItsSize) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float distance : {0.0f, 100.0f, 10000.0f}) {
      Scene scene = load_scene("cornell");
      scene.repairs = {};
      const float size = scene.bounds.diagonal();
      for (glm::vec3& p : scene.positions) p = scale * (p + glm::vec3(distance * size, 0.0f, 0.0f));
      warn_of_far_origin(scene);
      EXPECT_EQ(scene.repairs.warnings.size(), distance > 1000.0f ? 1u : 0u) << scale << " " << distance;
    }
}

// Red if NaN or infinite coordinates reach a texture lookup (assimp lets them through from some formats).
TEST(Repair, SetsNonFiniteUvsToZeroAndCountsThem) {
  Scene scene = two_triangles();
  scene.uvs[0] = {NAN, 0.5f};
  scene.uvs[3] = {0.5f, INFINITY};
  repair_scene(scene);
  EXPECT_EQ(scene.repairs.counts["non_finite_uvs_set_to_0"], 2);
  for (const glm::vec2& uv : scene.uvs) EXPECT_EQ(uv, glm::vec2(0.0f));
}

// Red if indices are used before they are checked.
TEST(Repair, RefusesIndicesOutOfRangeNamingTheTriangle) {
  for (int what = 0; what < 4; ++what) {
    Scene scene = two_triangles();
    if (what == 0) scene.triangles[1].v[2] = 4;
    if (what == 1) scene.triangles[1].material = 1;
    if (what == 2) scene.triangles[1].object = 1;
    if (what == 3) scene.materials[0].diffuse_texture = 0;
    try {
      repair_scene(scene);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("index"), std::string::npos) << error.what();
    }
  }
}

// Red if faces are weighted by count or area: a corner of three faces, one of them split in two, keeps its
// normal.
TEST(ComputedNormals, AreWeightedByAngleWithinTheCrease) {
  Scene scene;
  scene.name = "corner";
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 0}};
  scene.normals.assign(5, glm::vec3(0.0f));
  scene.uvs.assign(5, glm::vec2(0.0f));
  scene.triangles = {{{0, 4, 1}, 0, 0}, {{0, 2, 4}, 0, 0}, {{0, 3, 2}, 0, 0}, {{0, 1, 3}, 0, 0}};
  scene.materials.resize(1);
  scene.object_names = {"corner"};
  repair_normals(scene, 120.0f);
  const glm::vec3 n = scene.normals[scene.triangles[0].v[0]];
  EXPECT_NEAR(glm::length(n - glm::normalize(glm::vec3(-1, -1, -1))), 0.0f, 1e-6f);
}

// Red if the boundary or an inconsistent winding is missed.
TEST(Topology, CountsBoundaryNonManifoldAndFlippedEdges) {
  Scene scene = two_triangles();
  EdgeReport report = examine_edges(weld_positions(scene.positions), scene.triangles);
  EXPECT_EQ(report.edges, 5);
  EXPECT_EQ(report.boundary, 4);
  EXPECT_EQ(report.flipped, 0);
  std::swap(scene.triangles[1].v[0], scene.triangles[1].v[1]);
  EXPECT_EQ(examine_edges(weld_positions(scene.positions), scene.triangles).flipped, 1);
  scene.positions.push_back({0, 0, 1});
  scene.triangles.push_back({{2, 1, 4}, 0, 0});
  EXPECT_EQ(examine_edges(weld_positions(scene.positions), scene.triangles).non_manifold, 1);
}

// Red if -0.0 and 0.0 are different places.
TEST(Topology, WeldsNegativeZero) {
  const auto welded = weld_positions({{0.0f, 1.0f, -0.0f}, {-0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 1e-30f}});
  EXPECT_EQ(welded[1], 0u);
  EXPECT_EQ(welded[2], 2u);
}

}  // namespace
}  // namespace relight
