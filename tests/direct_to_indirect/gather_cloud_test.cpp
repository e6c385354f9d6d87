// The gather cloud: budget, areas, importances, sides.
#include "common/sampling/gather_cloud.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "common/sampling/random.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

// Evenly over both sides of everything.
GatherCloud even_cloud(const RayTracer& tracer, int64_t budget) {
  std::vector<SurfacePiece> pieces = cut_surfaces(tracer.scene(), 1e30);
  return make_gather_cloud(tracer, pieces, budget, 3);
}

double side_area(const Scene& scene) {
  double sum = 0.0;
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    sum += 0.5 * glm::length(glm::dvec3(scene.area_normal(t)));
  return sum;
}

// Red if the budget split loses or repeats a sample, or areas are not those of the sets they stand for.
TEST(GatherCloud, HasExactlyTheBudgetAndItsAreasSumToTheSurface) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  for (const int64_t budget : {1, 2, 7, 64, 4096}) {
    const GatherCloud cloud = even_cloud(tracer, budget);
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
  const GatherCloud cloud = even_cloud(tracer, 4096);
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
  const GatherCloud cloud = even_cloud(tracer, 1024);
  int tiny_samples = 0;
  double tiny_area = 0.0;
  for (size_t i = 0; i < cloud.samples.size(); ++i)
    if (cloud.samples[i].position.x > 4.0f) ++tiny_samples, tiny_area += cloud.area[i];
  EXPECT_LE(tiny_samples, 8);
  EXPECT_LE(tiny_area, 3e-12);
}

TEST(GatherCloud, RefusesASceneWithoutArea) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  std::vector<SurfacePiece> none;
  EXPECT_THROW(make_gather_cloud(tracer, none, 16, 1), Error);
}

// Red if a parallel sort or task depends on timing.
TEST(GatherCloud, HasTheSameBitsForOneAndTwoThreads) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  std::vector<GatherCloud> clouds;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    clouds.push_back(even_cloud(tracer, 1024));
  }
  for (size_t i = 0; i < 1024; ++i) {
    EXPECT_EQ(clouds[0].samples[i].position, clouds[1].samples[i].position);
    EXPECT_EQ(clouds[0].area[i], clouds[1].area[i]);
  }
}

// Red if a piece is lost when cut, or cut along the wrong edge for ever.
TEST(SurfacePieces, CuttingKeepsTheAreaAndBoundsEachPiece) {
  const Scene scene = tiny::room();
  double sum = 0.0;
  for (const SurfacePiece& p : cut_surfaces(scene, 0.01)) {
    EXPECT_LE(p.area, 0.01f);
    sum += p.area;
  }
  EXPECT_NEAR(sum, 2.0 * side_area(scene), 1e-5 * sum);
}

// Whatever the importances, sum f x area must estimate the integral of f. Red if a picked piece stands for
// the area of its set instead of weight / importance.
TEST(GatherCloud, EstimatesIntegralsWithoutBiasWhateverTheImportances) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  std::vector<SurfacePiece> pieces = cut_surfaces(scene, 0.002);
  for (size_t i = 0; i < pieces.size(); ++i) pieces[i].importance = 0.05f + 3.0f * random_float(8, 0, i, 0);
  double exact = 0.0;  // of f = 1 + x^2, by centroids of the small pieces
  for (const SurfacePiece& p : pieces) exact += p.area * (1.0 + p.centroid.x * p.centroid.x);
  double mean = 0.0;
  for (uint64_t seed = 0; seed < 32; ++seed) {
    const GatherCloud cloud = make_gather_cloud(tracer, pieces, 1024, seed);
    for (size_t i = 0; i < cloud.samples.size(); ++i) {
      const double x = cloud.samples[i].position.x;
      mean += cloud.area[i] * (1.0 + x * x) / 32.0;
    }
  }
  EXPECT_NEAR(mean, exact, 0.005 * exact);
}

// Red if sides are told apart by the wrong sign: then the inside of the block would get samples and its
// outside would not.
TEST(GatherCloudForView, LeavesTheInsideOfASolidAlone) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 64, 64});
  for (const CloudSampling sampling : {CloudSampling::uniform, CloudSampling::importance}) {
    const GatherCloud cloud = make_gather_cloud_for_view(tracer, {buffer}, sampling, 4096, 1);
    int on_block = 0;
    for (const SurfaceSample& s : cloud.samples) {
      if (s.triangle < 10) continue;  // the first five quads are walls: open sheets, seen from either side
      ++on_block;
      EXPECT_GT(glm::dot(s.geometric_normal, scene.area_normal(s.triangle)), 0.0f);
    }
    EXPECT_GT(on_block, 50);
  }
}

// A slab on a larger slab whose covered top shares vertices with the upper one's bottom: one component, same
// normals, a small distance apart. Red if bins do not tell the buried face from the visible one (it was so:
// -53 % on `temple`).
TEST(GatherCloudForView, LeavesBuriedFacesAlone) {
  Scene scene = tiny::empty_scene();
  tiny::add_box(scene, {-2, -0.05f, -2}, {2, 0, 2});
  tiny::add_box(scene, {-2, -0.1f, -2}, {2, -0.05f, 2});
  tiny::add_quad(scene, {-2, 1, -2}, {4, 0, 0}, {0, 0, 4});  // a ceiling to gather from
  scene.camera.eye = {0, 0.5f, 6};
  scene.camera.target = {0, 0.5f, 0};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 64, 64});
  const GatherCloud cloud = make_gather_cloud_for_view(tracer, {buffer}, CloudSampling::importance, 16384, 1);
  int visible = 0, buried = 0;
  for (const SurfaceSample& s : cloud.samples) {
    if (s.geometric_normal.y < 0.5f) continue;
    visible += std::abs(s.position.y) < 1e-3f;
    buried += std::abs(s.position.y + 0.05f) < 1e-3f;
  }
  EXPECT_GT(visible, 1000);
  EXPECT_EQ(buried, 0);
}

// Red if importance and area are exchanged: the lit side of the room's floor is gathered from more than its
// outside.
TEST(GatherCloudForView, PutsMoreSamplesWhereTheViewGathersMore) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 64, 64});
  const ImportanceMap map(tracer, {buffer}, 1 << 16, 0.5f, 1);
  const GatherCloud cloud = make_gather_cloud_for_view(tracer, {buffer}, CloudSampling::importance, 16384, 1);
  // Correlation, over the samples, of their bin's particles with their bin's samples.
  std::map<uint64_t, double> count;
  std::vector<uint64_t> bins;
  for (const SurfaceSample& s : cloud.samples) {
    const bool flipped = glm::dot(s.geometric_normal, scene.area_normal(s.triangle)) < 0.0f;
    bins.push_back(map.bin(s.position, s.triangle, flipped));
    count[bins.back()] += 1.0;
  }
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (const uint64_t bin : bins) {
    const double x = map.weight(bin), y = count[bin];
    xy += x * y, xx += x * x, yy += y * y;
  }
  EXPECT_GT(xy / std::sqrt(xx * yy), 0.9);
}

// A view of pure metal gathers by its lobes alone: their particles must be counted. Tried, each red:
// importance by diffuse particles only, which have no weight; lobes towards the normal instead of the eye.
TEST(GatherCloudForView, FollowsTheLobesOfGlossyViewSamples) {
  const Scene scene = tiny::room(2.0f, glm::vec3(0.0f), true);
  const RayTracer tracer(scene);
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 32, 24});
  for (SurfaceSample& s : buffer.indirect) s.diffuse = glm::vec3(0.0f), s.exponent = 1000.0f;
  EXPECT_EQ(ImportanceMap(tracer, {buffer}, 1 << 12, 0.5f, 1).total_weight(), 0.0);
  // Light from the back wall's lower half leaves towards the eye from the floor's mirror image of it.
  const SurfaceSample floor = buffer.indirect[22 * 32 + 16];
  ASSERT_GT(floor.shading_normal.y, 0.9f);
  buffer.indirect.assign(1, floor);
  const ImportanceMap map(tracer, {buffer, 1, true}, 1 << 12, 0.5f, 1);
  const glm::vec3 to_eye = glm::normalize(buffer.view.camera.eye - floor.position);
  const glm::vec3 mirror(-to_eye.x, to_eye.y, -to_eye.z);
  const Hit hit = tracer.intersect(tracer.offset_point(floor.position, floor.geometric_normal), mirror);
  ASSERT_TRUE(hit.valid);
  const SurfaceSample seen = tracer.surface(hit, mirror);
  const bool flipped = glm::dot(scene.area_normal(seen.triangle), seen.geometric_normal) < 0.0f;
  EXPECT_GT(map.weight(map.bin(seen.position, seen.triangle, flipped)), 0.3 * map.total_weight());
  EXPECT_GT(map.total_weight(), 0.2 * 0.25 * (1 << 12));
}

}  // namespace
}  // namespace relight
