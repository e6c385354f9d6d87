// Built-in scenes: sizes, soundness of the geometry, determinism, parameters.
#include <cmath>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/scene/scene_file.h"
#include "common/scene/topology.h"

namespace relight {
namespace {

// The smallest tessellation of each scene, for tests of properties that do not depend on it.
const char* const small_scenes[] = {"cornell",
                                    "cornell:open_front=0,detail=3",
                                    "colonnade:detail=0.3",
                                    "still_life:detail=0.3",
                                    "hair_ball:strands=50,segments=5",
                                    "temple:detail=0.1"};

std::vector<std::vector<Triangle>> triangles_by_object(const Scene& scene) {
  std::vector<std::vector<Triangle>> objects(scene.object_names.size());
  for (const Triangle& t : scene.triangles) objects[t.object].push_back(t);
  return objects;
}

// Single sheets on purpose: walls of rooms seen from inside, cloths, leaves.
bool is_sheet(const std::string& name) {
  for (const char* sheet : {"floor", "ceiling", "back", "left", "right", "front", "wall", "cloth", "leaves"})
    if (name == sheet || name == std::string(sheet) + " wall") return true;
  return false;
}

class EveryBuiltinScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Small, EveryBuiltinScene, testing::ValuesIn(small_scenes));

// Red if a helper winds a face inwards, or computes a shared edge by two expressions.
TEST_P(EveryBuiltinScene, SolidsAreClosedAndFaceOutward) {
  const Scene scene = load_scene(GetParam());
  const std::vector<uint32_t> welded = weld_positions(scene.positions);
  const auto objects = triangles_by_object(scene);
  for (size_t i = 0; i < objects.size(); ++i) {
    ASSERT_FALSE(objects[i].empty()) << scene.object_names[i];
    const bool has_volume =
        !is_sheet(scene.object_names[i]) || std::string(GetParam()).starts_with("colonnade");
    if (!has_volume || scene.object_names[i] == "cloth") continue;
    const EdgeReport edges = examine_edges(welded, objects[i]);
    EXPECT_EQ(edges.boundary, 0) << scene.object_names[i];
    EXPECT_EQ(edges.flipped, 0) << scene.object_names[i];
    EXPECT_GT(signed_volume(scene.positions, objects[i]), 0.0) << scene.object_names[i];
  }
}

// Red if a normal is left unnormalised or zero (poles, caps), or points into the solid.
TEST_P(EveryBuiltinScene, NormalsAreUnitAndOnTheOutside) {
  const Scene scene = load_scene(GetParam());
  for (const glm::vec3& n : scene.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
  size_t against = 0;
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    for (uint32_t v : scene.triangles[t].v)
      against += glm::dot(scene.normals[v], scene.area_normal(t)) <= 0.0f;
  EXPECT_EQ(against, 0u);
}

// Red if a generator writes an index past its vertices, a degenerate triangle or a mirror-bright material.
TEST_P(EveryBuiltinScene, IndicesAreasAndAlbedosAreValid) {
  const Scene scene = load_scene(GetParam());
  ASSERT_EQ(scene.normals.size(), scene.positions.size());
  ASSERT_EQ(scene.uvs.size(), scene.positions.size());
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& triangle = scene.triangles[t];
    for (uint32_t v : triangle.v) ASSERT_LT(v, scene.positions.size());
    ASSERT_LT(triangle.material, scene.materials.size());
    ASSERT_LT(triangle.object, scene.object_names.size());
    ASSERT_GT(glm::length(scene.area_normal(t)), 0.0f) << scene.object_names[triangle.object];
  }
  for (const Material& m : scene.materials) {
    const glm::vec3 albedo = m.diffuse + m.glossy;
    EXPECT_LE(std::max({albedo.x, albedo.y, albedo.z}), 1.0f) << m.name;
  }
}

// Red if a generator reads a clock, a thread id or an uninitialised value, or a preset is missing.
TEST_P(EveryBuiltinScene, IsDeterministicAndHasTheCommonPresets) {
  const Scene first = load_scene(GetParam()), second = load_scene(GetParam());
  EXPECT_EQ(first.content_hash, second.content_hash);
  for (const char* preset : {"spot", "omni"}) {
    EXPECT_NO_THROW(validate(load_lighting(first, preset)));
    EXPECT_FALSE(load_lighting(first, preset).lights.empty());
  }
}

struct ExpectedSize {
  const char* scene;
  double triangles, tolerance;
  glm::vec3 extent;
};
class FullSize : public testing::TestWithParam<ExpectedSize> {};
INSTANTIATE_TEST_SUITE_P(Default, FullSize,
                         testing::Values(ExpectedSize{"cornell", 34, 0, {2, 2, 2}},
                                         ExpectedSize{"colonnade", 66e3, 2e3, {35, 15.5, 16}},
                                         ExpectedSize{"still_life", 100e3, 5e3, {4, 3, 3.5}},
                                         ExpectedSize{"hair_ball", 320e3, 10e3, {8, 5, 7}},
                                         ExpectedSize{"temple", 2.1e6, 5e4, {80, 13, 80}}));

// Red if a change of a generator leaves the size class that results are published for.
TEST_P(FullSize, MatchesThePublishedTriangleCountAndExtent) {
  const Scene scene = load_scene(GetParam().scene);
  EXPECT_NEAR(double(scene.triangles.size()), GetParam().triangles, GetParam().tolerance);
  const glm::vec3 extent = scene.bounds.hi - scene.bounds.lo;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(extent[k], GetParam().extent[k], 0.05f * GetParam().extent[k]) << k;
}

// Red if the hash forgets one of the things that change a picture.
TEST(ContentHash, ChangesWithEveryKindOfContent) {
  Scene scene = load_scene("still_life:detail=0.2");
  const uint64_t original = scene.content_hash;
  const auto changed = [&](auto change) {
    Scene copy = scene;
    change(copy);
    finish_scene(copy);
    return copy.content_hash != original;
  };
  EXPECT_TRUE(changed([](Scene& s) { s.positions[5].y += 1e-5f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.normals[5] = -s.normals[5]; }));
  EXPECT_TRUE(changed([](Scene& s) { s.uvs.back().x += 0.5f; }));
  EXPECT_TRUE(changed([](Scene& s) { std::swap(s.triangles[0].v[0], s.triangles[0].v[1]); }));
  EXPECT_TRUE(changed([](Scene& s) { s.triangles[3].material += 1; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].exponent += 1.0f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].emission.x = 1.0f; }));
  // The colour and the first exponent unchanged: only the shape tells the models and their other parameters
  // apart.
  EXPECT_TRUE(changed([](Scene& s) {
    Material& m = s.materials[1];
    m.set_glossy_part(ashikhmin_shirley_part(m.glossy, m.exponent, 0.0f));
  }));
  EXPECT_TRUE(changed([](Scene& s) { s.textures[0].texels[7].y += 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.environment.radiance.z = 2.0f; }));
  EXPECT_FALSE(changed([](Scene& s) { s.camera.eye.x += 1.0f; }));
  EXPECT_FALSE(changed([](Scene& s) { s.lightings.clear(); }));
}

void expect_message(const std::string& scene, const std::vector<std::string>& parts) {
  try {
    load_scene(scene);
    ADD_FAILURE() << scene << " was accepted";
  } catch (const Error& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << part << " not in: " << error.what();
  }
}

// Red if a wrong parameter is ignored or the message leaves the user guessing.
TEST(BuiltinParameters, WrongNamesAndValuesAreRefusedWithTheValidOnes) {
  expect_message("cornell:bixes=2", {"bixes", "boxes", "open_front", "detail"});
  expect_message("cornell:boxes=many", {"boxes", "many", "not a number"});
  expect_message("cornell:boxes=1x", {"boxes", "1x", "not a number"});
  expect_message("cornell:boxes=7", {"boxes", "7", "0 to 2"});
  expect_message("cornell:boxes", {"boxes", "not a number"});
  expect_message("cornel", {"cornel", "cornell", "colonnade", "temple"});
  EXPECT_EQ(load_scene("cornell:boxes=0,detail=2").triangles.size(), 5u * 4u * 2u);
}

}  // namespace
}  // namespace relight
