// The exact twins that `relight explain-error` sets the method's approximations against: all of them together
// must be a sum over every gather sample, computed pair by pair in double.
#include <cstring>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/pixel_subset.h"
#include "common/scene/scene_file.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"
#include "methods/direct_to_indirect/error_stages.h"
#include "tests/direct_to_indirect/gather_oracle.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;
using test::TransferBench;

constexpr int width = 32, height = 24;

// All links to single samples, which is what the rows' oracle has; the near field has tests of its own.
TransferBench::Knobs every_twin_but_close_points(const TransferBench::Knobs& asked) {
  KnobValues values(make_direct_to_indirect()->knobs());
  TransferBench::Knobs knobs = asked;
  for (const auto& [name, value] : asked) values.set(name, value);
  for (const ErrorStage& stage : error_stages(values).stages)
    if (stage.active && stage.name != "close points")
      knobs.insert(knobs.end(), stage.exact.begin(), stage.exact.end());
  return knobs;
}

// Indirect light of the wanted pixels: k_d times the sum over all gather samples, at each sub-pixel.
Image oracle_picture(const GatherSetup& s, const std::vector<uint8_t>& wanted,
                     const LightingState& lighting) {
  const std::vector<glm::vec3> g =
      shade_direct_cpu(s.tracer, s.cloud.samples, s.scene.camera.eye, lighting, Lobes::diffuse);
  std::vector<glm::vec3> values(s.buffer.direct.size(), glm::vec3(0.0f));
  for (size_t i = 0; i < values.size(); ++i) {
    const SurfaceSample& v = s.buffer.direct[i];
    if (!v.valid || !wanted[i / (2 * width) / 2 * width + i % (2 * width) / 2]) continue;
    const std::vector<double> row = oracle_row(s, v, 0.1);
    glm::dvec3 sum(0.0);
    for (size_t j = 0; j < row.size(); ++j) sum += row[j] * glm::dvec3(g[j]);
    values[i] = glm::vec3(glm::dvec3(v.diffuse) * sum);
  }
  return box_filter_2x2(values, width, height);
}

// Every twin at once on some pixels, CPU and GPU, from the paper's knobs and from the farthest from them. The
// sums of 1,024 products and five Haar levels are in float; their roundings are independent, so the root of
// 1,000 times 2^-24 is the bound. Red if one of the twins leaves an approximation in (tried: coefficients=0
// kept a third of them; rows of pixels given to sub-pixels; 16-bit weights).
TEST(ExactTwins, TogetherAreTheSumOverEveryGatherSample) {
  GatherSetup setup(load_scene("cornell"), width, height, 1024);
  const LightingState lighting = setup.scene.lightings.at("near");
  TransferBench bench(load_scene("cornell"), width, height);
  ArtefactCache clouds = ArtefactCache::in_memory();
  bench.parts = &clouds;
  const PixelSubset subset = choose_pixels(width, height, 64, glm::ivec2(4), 1);
  bench.buffer.wanted = pixel_mask(subset);
  const Image expected = compact(oracle_picture(setup, bench.buffer.wanted, lighting), subset);
  ASSERT_GT(test::norm(expected), 0.0);
  for (const char* device : {"cpu", "gpu"})
    for (const TransferBench::Knobs& asked :
         {TransferBench::Knobs{},
          {{"column_scaling", "mean_row"}, {"row_budget", "shared"}, {"weights", "16"}},
          {{"refit_lights", "64"}, {"refit_candidates", "1.5"}, {"product", "rows"}}}) {
      TransferBench::Knobs knobs = asked;
      knobs.insert(knobs.end(), {{"device", device}, {"hierarchy_k", "30"}});
      StageLog log;
      const Relit relit = bench.prepare(every_twin_but_close_points(knobs))->relight(lighting, log);
      EXPECT_LT(relative_difference(compact(relit.indirect, subset), expected), 2e-6) << device;
    }
}

// The mean over all members keeps each row's sum, the share of the hemisphere that is covered, whatever the
// clusters: a row's scaling coefficient is that of the exact row. Red if a member's own visibility is not
// used, or the mean is divided by the square root of the size once too often (both tried).
TEST(ExactTwins, LinksToAllMembersKeepTheSumOfEveryRow) {
  GatherSetup s(load_scene("cornell"), 24, 18, 1024);
  FinalGatherSettings settings = exact_settings(1024);
  const SparseRows exact = s.final_gather(settings);
  settings.link_threshold = 0.5f;
  const SparseRows one = s.final_gather(settings);
  settings.link_members = 0;
  const SparseRows all = s.final_gather(settings);
  double sampled = 0.0;
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    const double sum = dense_row(exact, i)[0];
    EXPECT_NEAR(dense_row(all, i)[0], sum, 1e-5 * std::abs(sum));
    sampled = std::max(sampled, std::abs(dense_row(one, i)[0] - sum) / sum);
  }
  EXPECT_GT(sampled, 1e-3) << "clusters are too small for this test";
  EXPECT_LT(all.entries.size(), exact.entries.size()) << "details inside clusters are zero";
}

// Red if a stage calls itself inactive although its twin gives another picture (tried: shadows inactive on
// the GPU).
TEST(ExactTwins, OfInactiveStagesChangeNoBit) {
  TransferBench bench(load_scene("cornell"), width, height);
  ArtefactCache clouds = ArtefactCache::in_memory();
  bench.parts = &clouds;
  const LightingState lighting = bench.scene.lightings.at("near");
  for (const TransferBench::Knobs& asked :
       {TransferBench::Knobs{{"device", "cpu"}},
        {{"device", "gpu"}, {"weights", "float32"}},
        {{"device", "cpu"}, {"link_threshold", "0"}, {"coefficients", "0"}, {"upsampling", "none"}}}) {
    KnobValues values(make_direct_to_indirect()->knobs());
    for (const auto& [name, value] : asked) values.set(name, value);
    StageLog log;
    const auto picture = [&](const TransferBench::Knobs& knobs) {
      TransferBench::Knobs all = {{"link_threshold", "0.02"}};
      all.insert(all.end(), knobs.begin(), knobs.end());
      return bench.prepare(all)->relight(lighting, log).total;
    };
    const Image usual = picture(asked);
    int inactive = 0;
    for (const ErrorStage& stage : error_stages(values).stages) {
      if (stage.active) continue;
      ++inactive;
      TransferBench::Knobs knobs = asked;
      knobs.insert(knobs.end(), stage.exact.begin(), stage.exact.end());
      EXPECT_EQ(relative_difference(picture(knobs), usual), 0.0) << stage.name;
    }
    EXPECT_GE(inactive, 2);
  }
}

TEST(ExactTwins, RowsThatKeepEverythingHaveNothingToRefit) {
  TransferBench bench(load_scene("cornell"), 8, 6);
  EXPECT_THROW(bench.prepare({{"coefficients", "0"}, {"refit_lights", "16"}}), Error);
}

// Red if the two are accepted together (tried).
TEST(LinkElements, HaveNoMeanWhereColumnsAreScaled) {
  TransferBench bench(load_scene("cornell"), 8, 6);
  EXPECT_THROW(bench.prepare({{"link_element", "mean"}, {"column_scaling", "mean_row"}}), Error);
}

}  // namespace
}  // namespace relight::direct_to_indirect
