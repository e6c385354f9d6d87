// Direct light averaged over four points of each gather sample.
#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/light_points.h"
#include "tests/direct_to_indirect/gather_setup.h"
#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

// Evenly over the tiny room, in tree order; areas differ.
struct RoomPoints {
  Scene scene = tiny::room();
  RayTracer tracer{scene};
  GatherCloud cloud;
  RoomPoints() {
    std::vector<SurfacePiece> pieces = cut_surfaces(scene, 1e30);
    cloud = make_gather_cloud(tracer, pieces, 4096, 1);
    order_gather_cloud(cloud, 30.0f, scene.bounds.diagonal());
    for (size_t k = 0; k < cloud.area.size(); ++k) cloud.area[k] *= 1.0f + static_cast<float>(k % 3);
  }
};

// The light that leaves all gather samples is that which leaves all points, whatever the light: areas add up
// and means are weighted by them. Red if albedos or areas are not (tried: plain means).
TEST(LightPoints, KeepTheLightThatLeavesTheCloud) {
  const RoomPoints room;
  GatherCloud points = room.cloud;
  const GatherCloud samples = gather_samples_of(points);
  ASSERT_EQ(samples.samples.size(), 1024u);
  std::vector<glm::vec4> lit;
  double expected = 0.0;
  for (size_t k = 0; k < points.samples.size(); ++k) {
    const float irradiance = random_float(5, 6, k, 0);
    lit.push_back(irradiance * glm::vec4(points.samples[k].diffuse, 0.0f));
    expected += static_cast<double>(irradiance * room.cloud.samples[k].diffuse.x * room.cloud.area[k]);
  }
  std::vector<glm::vec4> means(1024);
  mean_of_points(lit, means);
  double sum = 0.0;
  for (size_t j = 0; j < means.size(); ++j)
    sum += static_cast<double>(means[j].x) * static_cast<double>(samples.area[j]);
  EXPECT_NEAR(sum, expected, 1e-5 * expected);
}

// A gather sample lies on the surface, among its own points.
TEST(LightPoints, AGatherSampleIsOneOfItsPoints) {
  const RoomPoints room;
  GatherCloud points = room.cloud;
  const GatherCloud samples = gather_samples_of(points);
  for (size_t j = 0; j < samples.samples.size(); ++j) {
    size_t same = 0;
    for (size_t k = 4 * j; k < 4 * j + 4; ++k)
      same += points.samples[k].position == samples.samples[j].position;
    EXPECT_GE(same, 1u) << j;
  }
}

TEST(LightPoints, GpuMeansEqualTheCpus) {
  const auto context = gpu::Context::create("osmesa");
  std::vector<glm::vec4> points;
  for (uint64_t k = 0; k < 4 * 1000; ++k)
    points.emplace_back(random_float(1, 1, k, 0), random_float(1, 1, k, 1), random_float(1, 1, k, 2), 0.0f);
  std::vector<glm::vec4> means(1000);
  mean_of_points(points, means);
  const MeanOfPointsGpu gpu(means.size());
  EXPECT_EQ(gpu.mean(gpu::Buffer::from(points)).download<glm::vec4>(), means);
}

// The point of it: a sharp rim that crosses the cells. Against a cloud of 16 times as many samples, all
// coefficients and links. Red if the mean is not taken, or the light of other samples (tried: the first of
// the four points alone; points of the sample after).
TEST(LightPoints, BringTheRimOfASpotCloserToThatOfAFinerCloud) {
  test::TransferBench bench(tiny::room(), 8, 8);
  const LightingState lighting =
      tiny::lighting({tiny::spot({-0.4f, 0.9f, 0.5f}, {0.2f, -1.0f, -0.1f}, 19.99f, 20.0f, glm::vec3(3.0f))});
  const auto indirect = [&](const char* samples, const char* points, const char* device = "cpu") {
    StageLog log;
    return bench
        .prepare({{"device", device},
                  {"weights", "float32"},
                  {"shadows", "traced"},
                  {"gather_samples", samples},
                  {"link_threshold", "0"},
                  {"coefficients", "0"},
                  {"light_points", points}})
        ->relight(lighting, log)
        .indirect;
  };
  const Image fine = indirect("16384", "1"), one = indirect("1024", "1"), four = indirect("1024", "4");
  EXPECT_LT(test::relative_difference(four, fine), 0.7 * test::relative_difference(one, fine));
  EXPECT_LT(test::relative_difference(indirect("1024", "4", "gpu"), four), 6e-6);
}

}  // namespace
}  // namespace relight::direct_to_indirect
