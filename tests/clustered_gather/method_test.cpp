// The whole method: its three devices against each other, its limits against a plain Monte Carlo sum, and the
// laws that relighting obeys. Tried, each red: a cluster's last sample left out; the first link of a texel
// twice; a link's weight for its neighbours; weights that sum to less than one; a cache key without knobs; a
// relight knob in it.
#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"
#include "methods/clustered_gather/artefact.h"
#include "tests/clustered_gather/gather_bench.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

using test::Knobs;
using test::norm;
using test::relative_difference;

struct Bench : test::GatherBench {
  explicit Bench(bool glossy = false) : GatherBench(tiny::room(2.0f, glm::vec3(0.0f), glossy)) {}
  Relit relight(const Knobs& knobs, const std::vector<Light>& lights) {
    Relit relit = GatherBench::relight(knobs, {"tiny", lights});
    EXPECT_TRUE(relight_log.warnings().empty());
    return relit;
  }
};

const Light lamp = tiny::omni({0.2f, 0.4f, 0.7f}),
            other = tiny::spot({-0.3f, 0.8f, 0.6f}, {0.1f, -1, -0.2f}, 20, 30);

// Sums of 16 samples and of 10 links in float: 30 roundings of 2^-24 = 1.8e-6. With shadow maps the pictures
// would differ by their shadows, so all three trace them. Red if a link's weight goes to its neighbour, a
// cluster's samples end one early, or the albedo is applied twice.
TEST(ClusteredGather, CpuAndGpuAgreeWithTheDoublePrecisionOracle) {
  for (const bool glossy : {false, true}) {
    Bench bench(glossy);
    const auto with = [&](const char* device) {
      return bench.relight({{"shadows", "traced"}, {"device", device}}, {lamp, other});
    };
    const Relit oracle = with("oracle"), gpu = with("gpu"), cpu = with("cpu");
    EXPECT_GT(norm(oracle.indirect), 0.0);
    EXPECT_LT(relative_difference(gpu.indirect, oracle.indirect), 2e-6);
    EXPECT_LT(relative_difference(cpu.indirect, oracle.indirect), 4e-6);  // shading by another compiler, too
    EXPECT_LT(relative_difference(cpu.direct, oracle.direct), glossy ? 2e-5 : 4e-6);
  }
}

// The same samples on every device, and a picture close to that of floats: positions move by at most 2^-11 of
// half the room, normals by 0.014 rad. Red if links take each other's weights, or one device keeps floats.
TEST(ClusteredGather, CompactStorageIsTheSameOnEveryDeviceAndCloseToFloats) {
  for (const bool glossy : {false, true}) {
    Bench bench(glossy);
    const auto with = [&](const char* device, const char* storage) {
      return bench.relight({{"shadows", "traced"}, {"device", device}, {"storage", storage}}, {lamp, other});
    };
    const Relit full = with("gpu", "full");
    int64_t bytes = bench.precompute_log.bytes().at("gather_samples");
    for (const char* storage : {"half", "bytes"}) {
      const Relit oracle = with("oracle", storage), gpu = with("gpu", storage);
      EXPECT_LT(bench.precompute_log.bytes().at("gather_samples"), bytes * 2 / 3);
      bytes = bench.precompute_log.bytes().at("gather_samples");
      const Relit cpu = with("cpu", storage);
      EXPECT_LT(relative_difference(gpu.indirect, oracle.indirect), 2e-6);
      EXPECT_LT(relative_difference(cpu.indirect, oracle.indirect), 4e-6);
      const double change = relative_difference(gpu.indirect, full.indirect);
      EXPECT_GT(change, 1e-6) << storage;
      EXPECT_LT(change, 0.01) << storage;
    }
  }
}

// Red if something glossy is computed, stored or timed for a view without gloss, or although it is off.
TEST(ClusteredGather, ComputesNothingGlossyWithoutGloss) {
  Bench matt, shiny(true);
  matt.prepare({});
  EXPECT_EQ(matt.precompute_log.counters().count("glossy_view_clusters"), 0u);
  EXPECT_EQ(matt.precompute_log.counters().count("glossy_gather_rays"), 0u);
  shiny.prepare({{"glossy", "off"}});
  EXPECT_EQ(shiny.precompute_log.counters().count("glossy_gather_rays"), 0u);
  shiny.prepare({});
  EXPECT_GT(shiny.precompute_log.counters().at("glossy_gather_rays"), 0);
  EXPECT_EQ(shiny.precompute_log.counters().at("view_clusters") +
                shiny.precompute_log.counters().at("glossy_view_clusters"),
            200);
  EXPECT_TRUE(shiny.method->light_paths(KnobValues(shiny.method->knobs())).glossy_at_eye);
  EXPECT_GT(norm(shiny.relight({{"device", "cpu"}}, {lamp}).indirect),
            1.05 * norm(shiny.relight({{"device", "cpu"}, {"glossy", "off"}}, {lamp}).indirect));
}

// Every pixel its own cluster, every ray its own sample, one neighbour: a plain Monte Carlo estimate,
// computed here from the definition (equation 2) with the same directions.
TEST(ClusteredGather, WithoutClusteringIsPlainMonteCarlo) {
  Bench bench;
  constexpr int directions = 64;
  const Relit relit = bench.relight({{"view_clusters", "0"},
                                     {"gather_clusters", "0"},
                                     {"neighbours", "1"},
                                     {"directions", std::to_string(directions)},
                                     {"device", "cpu"}},
                                    {lamp});
  std::vector<glm::vec3> indirect;
  uint64_t cluster = 0;
  for (const SurfaceSample& s : bench.buffer.indirect) {
    glm::dvec3 sum(0.0);
    if (s.valid) {
      const uint64_t scramble = random_bits(1, 0x67617468657231ull, cluster++, 0);
      std::vector<SurfaceSample> hits;
      for (uint32_t i = 0; i < directions; ++i) {
        const glm::vec3 w = sample_cosine(s.shading_normal, sobol_2d(i, scramble));
        if (!(glm::dot(w, s.geometric_normal) > 0.0f)) continue;
        const Hit hit = bench.tracer.intersect(bench.tracer.offset_point(s.position, s.geometric_normal), w);
        if (hit.valid) hits.push_back(bench.tracer.surface(hit, w));
      }
      for (const glm::vec3& l : shade_direct_cpu(bench.tracer, hits, bench.scene.camera.eye,
                                                 tiny::lighting({lamp}), Lobes::diffuse))
        sum += glm::dvec3(l) / static_cast<double>(directions);
    }
    indirect.push_back(glm::vec3(sum * glm::dvec3(s.diffuse)));
  }
  const Image expected = reconstruct_indirect_cpu(bench.buffer, closest_view_samples(bench.buffer), indirect);
  EXPECT_LT(relative_difference(relit.indirect, expected), 1e-5);
}

// Red if anything is clamped or depends on the lights before.
TEST(ClusteredGather, IsLinearInTheLights) {
  Bench bench;
  const Knobs cpu = {{"device", "cpu"}};
  const Relit a = bench.relight(cpu, {lamp}), b = bench.relight(cpu, {other}),
              both = bench.relight(cpu, {lamp, other});
  Image sum = a.indirect;
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += b.indirect.pixels[i];
  EXPECT_LT(relative_difference(both.indirect, sum), 1e-6);
}

// Red if a precompute knob is missing from the key, or a relight knob in it; or if gather samples keep a
// glossy part, which only those from the cache do not have.
TEST(ClusteredGather, TheCacheGivesTheSamePictureAndKnowsThePrecomputeKnobs) {
  Bench bench(true);
  const Relit made = bench.relight({{"device", "cpu"}}, {lamp});
  EXPECT_EQ(bench.precompute_log.counters().count("cache_hits"), 0u);
  const auto bytes = bench.precompute_log.bytes();
  const Relit loaded = bench.relight({{"device", "cpu"}, {"shadow_map_size", "256"}}, {lamp});
  EXPECT_EQ(bench.precompute_log.counters().at("cache_hits"), 1);
  EXPECT_EQ(bench.precompute_log.bytes(), bytes);
  EXPECT_EQ(relative_difference(made.indirect, loaded.indirect), 0.0);
  bench.relight({{"device", "cpu"}, {"iterations", "3"}}, {lamp});
  EXPECT_EQ(bench.precompute_log.counters().count("cache_hits"), 0u);
}

TEST(ClusteredGather, IsBlackWithoutLightAndForAViewOfNothing) {
  Bench bench;
  EXPECT_EQ(norm(bench.relight({}, {}).total), 0.0);
  for (SurfaceSample& s : bench.buffer.indirect) s.valid = false;
  for (SurfaceSample& s : bench.buffer.direct) s.valid = false;
  bench.cache = ArtefactCache::in_memory();
  for (const char* device : {"gpu", "cpu", "oracle"})
    EXPECT_EQ(norm(bench.relight({{"device", device}}, {lamp}).total), 0.0) << device;
}

TEST(ClusteredGather, RefusesShadowMapsOnTheCpu) {
  Bench bench;
  EXPECT_THROW(bench.prepare({{"device", "cpu"}, {"shadows", "map"}}), std::exception);
}

}  // namespace
}  // namespace relight
