// Gather samples of view clusters: what the rays find, and what clustering them keeps. Tried, each red:
// misses kept; 99 % of the weight; directions below the surface traced; the first member for the closest; a
// mean taken whatever its length, or whatever side it is on.
#include <gtest/gtest.h>

#include <cmath>

#include <tbb/global_control.h>
#include <glm/gtc/constants.hpp>

#include "methods/clustered_gather/gather_samples.h"
#include "methods/clustered_gather/representative.h"
#include "tests/support/tiny_scenes.h"

namespace relight::clustered_gather {
namespace {

struct RoomGather {
  Scene scene;
  RayTracer tracer;
  ViewClusters view;
  Metric6 metric;

  explicit RoomGather(Scene s, size_t clusters = 60)
      : scene(std::move(s)), tracer(scene), metric(scene.bounds.diagonal(), 1.0f) {
    ClusteringSettings settings;
    settings.clusters = clusters;
    const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 48, 36});
    view = cluster_view(buffer, pixels_with(buffer, Part::diffuse), metric, settings);
  }
  GatherSamples gather(int directions, size_t clusters, StageLog& log) {
    GatherSettings settings;
    settings.directions = directions;
    settings.clusters = clusters;
    Progress quiet(true);
    GatherSamples out;
    add_gather_samples(tracer, view, metric, settings, quiet, log, out);
    return out;
  }
  GatherSamples gather(int directions, size_t clusters) {
    StageLog log;
    return gather(directions, clusters, log);
  }
};

// A floor under an empty sky, seen from above.
Scene floor_alone() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  scene.camera.eye = {0.0f, 2.0f, 0.1f};
  scene.camera.target = glm::vec3(0.0f);
  finish_scene(scene);
  return scene;
}

// A closed box of diffuse albedo 0.6, seen from inside.
Scene closed_box(const GlossyPart& part = {}) {
  Scene scene = tiny::empty_scene(glm::vec3(0.6f));
  scene.materials[0].set_glossy_part(part);
  tiny::add_box(scene, glm::vec3(-1.0f), glm::vec3(1.0f));
  scene.camera.eye = {0.1f, 0.2f, 0.9f};
  scene.camera.target = {0.0f, 0.0f, -1.0f};
  finish_scene(scene);
  return scene;
}

glm::dvec3 sum_of_albedos(const GatherSamples& g, size_t k) {
  glm::dvec3 sum(0.0);
  for (uint32_t i = g.first[k]; i < g.first[k + 1]; ++i) sum += glm::dvec3(g.samples[i].diffuse);
  return sum;
}

// Sum of weight x albedo, cluster by cluster. Red if a member's weight or albedo is lost or counted twice.
TEST(GatherSamples, ClusteringKeepsTheSumOfWeightTimesAlbedo) {
  RoomGather s(tiny::room());
  const GatherSamples all = s.gather(400, 0), few = s.gather(400, 24);
  ASSERT_EQ(all.first.size(), few.first.size());
  EXPECT_LT(few.samples.size(), all.samples.size() / 4);
  for (size_t k = 0; k + 1 < all.first.size(); ++k) {
    const glm::dvec3 difference = sum_of_albedos(all, k) - sum_of_albedos(few, k);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(difference[c], 0.0, 1e-6);
    EXPECT_LE(few.first[k + 1] - few.first[k], 24u);
  }
}

// Inside a closed box of albedo a every ray hits, so the weights alone sum to a. Red if the weight is not
// 1 / directions, or rays start below the surface.
TEST(GatherSamples, OfAClosedBoxOfOneAlbedoSumToIt) {
  RoomGather s(closed_box());
  const GatherSamples g = s.gather(500, 40);
  for (size_t k = 0; k + 1 < g.first.size(); ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum_of_albedos(g, k)[c], 0.6, 1e-5);
}

// As many clusters as points, or more: nothing is clustered.
TEST(GatherSamples, WithOneClusterASampleAreTheUnclusteredOnes) {
  RoomGather s(tiny::room(), 20);
  const GatherSamples all = s.gather(100, 0), own = s.gather(100, 100);
  ASSERT_EQ(all.samples.size(), own.samples.size());
  for (size_t i = 0; i < all.samples.size(); ++i) {
    EXPECT_EQ(all.samples[i].position, own.samples[i].position);
    EXPECT_EQ(all.samples[i].diffuse, own.samples[i].diffuse);
  }
}

// Red if a miss becomes a sample.
TEST(GatherSamples, OfAViewThatSeesNothingAreNone) {
  RoomGather s(floor_alone());
  StageLog log;
  const GatherSamples g = s.gather(100, 10, log);
  ASSERT_GT(s.view.samples.size(), 10u);
  EXPECT_TRUE(g.samples.empty());
  EXPECT_EQ(g.first, std::vector<uint32_t>(s.view.samples.size() + 1, 0u));
  EXPECT_EQ(log.counters().at("gather_points"), 0);
  EXPECT_GT(log.counters().at("gather_rays"), 0);
}

TEST(GatherSamples, HaveTheSameBitsForOneAndTwoThreads) {
  RoomGather s(tiny::room());
  const auto run = [&](size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return s.gather(200, 16);
  };
  const GatherSamples one = run(1), two = run(2);
  ASSERT_EQ(one.first, two.first);
  for (size_t i = 0; i < one.samples.size(); ++i) {
    ASSERT_EQ(one.samples[i].position, two.samples[i].position);
    ASSERT_EQ(one.samples[i].shading_normal, two.samples[i].shading_normal);
    ASSERT_EQ(one.samples[i].diffuse, two.samples[i].diffuse);
  }
}

SurfaceSample sample(const glm::vec3& position, const glm::vec3& normal) {
  SurfaceSample s;
  s.position = position;
  s.shading_normal = s.geometric_normal = normal;
  s.valid = true;
  return s;
}

// Red if a mean of zero is normalised, or turns a sample towards what is behind it.
TEST(Representative, OfOpposingNormalsKeepsAMembersNormal) {
  const glm::vec3 up(0, 1, 0);
  std::vector<SurfaceSample> two = {sample({0, 0, 0}, up), sample({1, 0, 0}, -up)};
  const std::vector<uint32_t> both = {0, 1};
  EXPECT_EQ(representative(two, both).shading_normal, up);
  // Two of three point the other way: the mean is behind the surface of the member in the middle.
  two.push_back(sample({-1, 0, 0}, -up));
  const std::vector<uint32_t> three = {1, 0, 2};
  EXPECT_EQ(representative(two, three).position, glm::vec3(0.0f));
  EXPECT_EQ(representative(two, three).shading_normal, up);
}

// What is left of normals that cancel each other points anywhere. Red if it is taken for a direction.
TEST(Representative, OfNormalsThatNearlyCancelKeepsAMembersNormal) {
  const glm::vec3 up(0, 1, 0), nearly_down = glm::normalize(glm::vec3(1e-3f, -1.0f, 0.0f));
  std::vector<SurfaceSample> two = {sample({0, 0, 0}, up), sample({1, 0, 0}, nearly_down)};
  const std::vector<uint32_t> both = {0, 1};
  EXPECT_EQ(representative(two, both).shading_normal, up);
}

// A floor alone, seen with a shading normal that leans over it: half of the directions start below the floor,
// and hit it at once from above if nobody looks. Red if they are traced.
TEST(GatherSamples, DirectionsBelowTheGeometricSurfaceCountAsBlack) {
  RoomGather s(floor_alone());
  for (SurfaceSample& v : s.view.samples) v.shading_normal = glm::normalize(glm::vec3(1.0f, 0.1f, 0.0f));
  EXPECT_TRUE(s.gather(200, 0).samples.empty());
}

// Integral of f cos over the hemisphere around n, by a grid in (cos^2, phi).
double glossy_albedo(const SurfaceSample& s, const glm::vec3& eye) {
  const glm::mat3 frame = frame_around(s.shading_normal);
  const glm::vec3 wo = glm::normalize(eye - s.position);
  constexpr int n = 600;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double z2 = (i + 0.5) / n, phi = 2.0 * glm::pi<double>() * (j + 0.5) / n;
      const double r = std::sqrt(1.0 - z2);
      const glm::vec3 wi = frame * glm::vec3(glm::dvec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(z2)));
      sum += static_cast<double>(shader::brdf_glossy(s.brdf(), s.shading_normal, wo, wi).x);
    }
  return sum * glm::pi<double>() / (n * n);
}

// In a closed box of diffuse albedo 0.6 every glossy ray that leaves upwards meets it: the weights sum to the
// directional albedo of the lobe. 4000 directions: 1 % of a smooth integrand. Red if the density is that of
// the mixture with the diffuse part, the cosine is missing, or the eye is looked for elsewhere.
TEST(GatherSamples, OfTheGlossyPartSumToTheAlbedoOfItsLobe) {
  for (const GlossyPart& part : {phong_part(glm::vec3(0.3f), 20.0f), ggx_part(glm::vec3(0.5f), 0.3f, 0.3f)}) {
    RoomGather s(closed_box(part), 12);
    GatherSettings settings;
    settings.directions = 4000;
    settings.clusters = 30;
    settings.part = Part::glossy;
    settings.eye = s.scene.camera.eye;
    Progress quiet(true);
    StageLog log;
    GatherSamples g;
    add_gather_samples(s.tracer, s.view, s.metric, settings, quiet, log, g);
    ASSERT_EQ(g.first.size(), s.view.samples.size() + 1);
    for (size_t k = 0; k + 1 < g.first.size(); ++k) {
      const double expected = 0.6 * glossy_albedo(s.view.samples[k], settings.eye);
      EXPECT_NEAR(sum_of_albedos(g, k).x, expected, 0.01 * expected) << k;
    }
  }
}

// Shares of 40,000 by the albedos seen. Red if the parts are swapped, or a part that is there gets nothing.
TEST(ViewClusters, AreSplitByTheEnergySeen) {
  DeepFrameBuffer buffer;
  SurfaceSample s = sample({0, 0, 0}, {0, 1, 0});
  s.diffuse = glm::vec3(0.6f);
  buffer.indirect = {s, s, s, {}};
  EXPECT_EQ(split_by_energy(buffer, 40000).glossy, 0u);
  buffer.indirect[0].glossy = glm::vec3(0.6f);
  EXPECT_EQ(split_by_energy(buffer, 40000).glossy, 10000u);
  EXPECT_EQ(split_by_energy(buffer, 40000).diffuse, 30000u);
  buffer.indirect[0].glossy = glm::vec3(1e-6f);
  EXPECT_EQ(split_by_energy(buffer, 40000).glossy, 1u);
  EXPECT_EQ(split_by_energy(buffer, 0).diffuse, 0u);
}

}  // namespace
}  // namespace relight::clustered_gather
