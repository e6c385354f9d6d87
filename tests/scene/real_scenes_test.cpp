// The real scenes and models, where the shared data is at hand.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/scene/files/image_file.h"
#include "common/scene/scene_file.h"
#include "common/scene/topology.h"

namespace relight {
namespace {

std::string shared() {
  const char* folder = std::getenv("RELIGHT_SHARED_SCENES");
  return folder && *folder ? folder : std::string(RELIGHT_SOURCE_DIR) + "/../shared/scenes";
}

int64_t count(const Scene& scene, const char* what) {
  const auto found = scene.repairs.counts.find(what);
  return found == scene.repairs.counts.end() ? 0 : found->second;
}

struct RealMesh {
  const char* file;
  int64_t triangles_in_file, zero_area_in_file, unused_vertices;
  bool closed;
};
void PrintTo(const RealMesh& mesh, std::ostream* out) { *out << mesh.file; }

class RealMeshes : public testing::TestWithParam<RealMesh> {};
INSTANTIATE_TEST_SUITE_P(
    Shared, RealMeshes,
    testing::Values(RealMesh{"scenes/dabrovic_sponza/dabrovic_sponza.obj", 66450, 1, 0, false},
                    RealMesh{"scenes/contemporary_bathroom/contemporary_bathroom.obj", 127360, 225, 0, false},
                    RealMesh{"scenes/country_kitchen/country_kitchen.obj", 221424, 716, 0, false},
                    RealMesh{"models/stanford_bunny.ply", 69451, 0, 1113, false},
                    RealMesh{"models/stanford_dragon_202k.ply", 202520, 0, 43, false},
                    RealMesh{"models/stanford_dragon_48k.ply", 47794, 0, 16, false},
                    RealMesh{"models/stanford_armadillo_52k.ply", 52000, 0, 0, true},
                    RealMesh{"models/utah_teapot.ply", 992, 0, 0, false}));

// Red if triangles vanish without being counted, or zero-area ones of the README are missed.
TEST_P(RealMeshes, AccountForEveryTriangleOfTheFile) {
  const std::string file = shared() + "/" + GetParam().file;
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no shared data: " << file << " (set RELIGHT_SHARED_SCENES)";
  const Scene scene = load_scene(file);
  const int64_t zero_area = count(scene, "zero_area_triangles_removed");
  const int64_t glass = count(scene, "clear_glass_triangles_left_out");
  const int64_t removed = zero_area + count(scene, "duplicate_triangles_removed") + glass;
  EXPECT_EQ(static_cast<int64_t>(scene.triangles.size()) + removed, GetParam().triangles_in_file);
  // Zero-area triangles of clear glass are counted as glass.
  EXPECT_LE(zero_area, GetParam().zero_area_in_file);
  if (glass == 0) {
    EXPECT_EQ(zero_area, GetParam().zero_area_in_file);
  }
  EXPECT_EQ(count(scene, "unused_vertices_removed"), GetParam().unused_vertices);
  EXPECT_EQ(examine_edges(weld_positions(scene.positions), scene.triangles).closed(), GetParam().closed);
  EXPECT_EQ(count(scene, "textures_missing"), 0);
}

class RealSceneFiles : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, RealSceneFiles, testing::Values("sponza", "kitchen", "bathroom"));

// Red if a shipped scene file has a typo or an eye outside its building.
TEST_P(RealSceneFiles, LoadWithTheirCameraInsideAndTheCommonPresets) {
  if (!std::filesystem::exists(shared() + "/scenes"))
    GTEST_SKIP() << "no shared data (set RELIGHT_SHARED_SCENES)";
  setenv("RELIGHT_SHARED_SCENES", shared().c_str(), 1);
  const Scene scene = load_scene(std::string(RELIGHT_SOURCE_DIR) + "/scenes/" + GetParam() + ".toml");
  EXPECT_TRUE(glm::all(glm::lessThan(scene.bounds.lo, scene.camera.eye)));
  EXPECT_TRUE(glm::all(glm::lessThan(scene.camera.eye, scene.bounds.hi)));
  for (const char* preset : {"spot", "omni"})
    for (const Light& light : load_lighting(scene, preset).lights) {
      EXPECT_TRUE(glm::all(glm::lessThan(scene.bounds.lo, light.position))) << preset;
      EXPECT_TRUE(glm::all(glm::lessThan(light.position, scene.bounds.hi))) << preset;
    }
}

// Red if half-float or RGBE maps are decoded as sRGB, or scaled: largest and mean values from the data's
// README.
TEST(RealEnvironments, HaveTheDocumentedLargestAndMeanRadiance) {
  const std::string file = shared() + "/hdr/vestibule_1k.hdr";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no shared data: " << file << " (set RELIGHT_SHARED_SCENES)";
  Environment environment;
  load_environment_map(file, environment);
  ASSERT_EQ(environment.texels.size(), 1024u * 512u);
  glm::vec3 largest(0.0f);
  glm::dvec3 sum(0.0);
  for (const glm::vec3& texel : environment.texels) {
    largest = glm::max(largest, texel);
    sum += glm::dvec3(texel);
  }
  EXPECT_EQ(largest, glm::vec3(170, 200, 224));
  EXPECT_NEAR(sum.x / (1024.0 * 512.0), 0.749, 0.001);
  EXPECT_NEAR(sum.z / (1024.0 * 512.0), 0.654, 0.001);
}

}  // namespace
}  // namespace relight
