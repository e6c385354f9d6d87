// The uniform gather cloud and the choice of live sides.
#include "common/sampling/gather_cloud.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

double side_area(const Scene& scene) {
  double sum = 0.0;
  for (size_t t = 0; t < scene.triangles.size(); ++t) sum += 0.5 * glm::length(glm::dvec3(scene.area_normal(t)));
  return sum;
}

// Red if the budget split loses or repeats a sample, or areas are not those of the sets they stand for.
TEST(GatherCloud, HasExactlyTheBudgetAndItsAreasSumToTheSurface) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  for (const int64_t budget : {1, 2, 7, 64, 4096}) {
    const GatherCloud cloud = make_uniform_gather_cloud(tracer, all_sides_live(scene), budget, 3);
    ASSERT_EQ(cloud.samples.size(), static_cast<size_t>(budget));
    double sum = 0.0;
    for (const float a : cloud.area) sum += a;
    EXPECT_NEAR(sum, 2.0 * side_area(scene), 1e-5 * sum) << budget;
    for (const SurfaceSample& s : cloud.samples) ASSERT_TRUE(s.valid);
  }
}

// Red if the square is mapped to the triangle without preserving area, or budgets do not follow area.
TEST(GatherCloud, CountsAreProportionalToArea) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {0, 0, 0}, {3, 0, 0}, {0, 0, 1});
  finish_scene(scene);
  const RayTracer tracer(scene);
  const GatherCloud cloud = make_uniform_gather_cloud(tracer, all_sides_live(scene), 4096, 3);
  // 12 strips in x: 341.3 samples expected each; a stratified sequence stays within a few per cent.
  std::map<int, int> strips;
  for (const SurfaceSample& s : cloud.samples) ++strips[static_cast<int>(s.position.x * 4.0f)];
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(strips[i], 4096 / 12, 20) << "strip " << i;
}

// Red if the recursion compares areas without regard to rounding (zero budget or a lost triangle).
TEST(GatherCloud, SurvivesTwoTrianglesOfAreaRatio1e12) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  tiny::add_quad(scene, {5, 0, 0}, {1e-6f, 0, 0}, {0, 0, 1e-6f});
  finish_scene(scene);
  const RayTracer tracer(scene);
  const GatherCloud cloud = make_uniform_gather_cloud(tracer, all_sides_live(scene), 1024, 3);
  int tiny_samples = 0;
  double tiny_area = 0.0;
  for (size_t i = 0; i < cloud.samples.size(); ++i)
    if (cloud.samples[i].position.x > 4.0f) ++tiny_samples, tiny_area += cloud.area[i];
  EXPECT_LE(tiny_samples, 8);
  EXPECT_LE(tiny_area, 3e-12);
}

TEST(GatherCloud, RefusesASceneWithoutArea) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  finish_scene(scene);
  const RayTracer tracer(scene);
  LiveSides none;
  none.sides.assign(scene.triangles.size(), 0);
  EXPECT_THROW(make_uniform_gather_cloud(tracer, none, 16, 1), Error);
}

// Red if a parallel sort or task depends on timing.
TEST(GatherCloud, HasTheSameBitsForOneAndTwoThreads) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  std::vector<GatherCloud> clouds;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    clouds.push_back(make_uniform_gather_cloud(tracer, all_sides_live(scene), 1024, 3));
  }
  for (size_t i = 0; i < 1024; ++i) {
    EXPECT_EQ(clouds[0].samples[i].position, clouds[1].samples[i].position);
    EXPECT_EQ(clouds[0].area[i], clouds[1].area[i]);
  }
}

// Red if sides are counted by the wrong sign: then the inside of the block would live and its outside would not.
TEST(LiveSides, KeepTheOutsideOfASolidAndDropItsInside) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 64, 64});
  const LiveSides live = find_live_sides(tracer, buffer, 1);
  int block = 0;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const glm::vec3 n = glm::normalize(scene.area_normal(t));
    if (t < 10) continue;  // walls: open sheets
    ++block;
    // The block's own bottom lies on the floor and may be dead on both sides.
    if (std::abs(n.y) < 0.5f) {
      EXPECT_EQ(live.sides[t], 1) << "triangle " << t;
    }
  }
  EXPECT_EQ(block, 12);
}

}  // namespace
}  // namespace relight
