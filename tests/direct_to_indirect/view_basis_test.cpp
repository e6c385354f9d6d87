// Rows that belong to wavelets over 4x4 view samples instead of single ones.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "methods/direct_to_indirect/row_builder.h"
#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;
using test::TransferBench;

const Light beam = tiny::spot({-0.4f, 0.9f, 0.5f}, {0.2f, -1.0f, -0.1f}, 15.0f, 20.0f, glm::vec3(3.0f));
const LightingState lighting = tiny::lighting({beam});

int64_t counter(const StageLog& log, const std::string& name) {
  for (const auto& [n, value] : log.counters())
    if (n == name) return value;
  return -1;
}

TransferBench::Knobs with(TransferBench::Knobs knobs, const TransferBench::Knobs& more) {
  knobs.insert(knobs.end(), more.begin(), more.end());
  return knobs;
}

// With every coefficient kept the basis is a change of variables: the pictures differ by rounding (1e-5). The
// view is 18x14, so that its last tiles are cut by the border. Red if a row goes to another pixel, k_d is
// applied to wavelets, or a cut tile is transformed (tried: each of the first two).
TEST(ViewBasis, GivesTheSamePictureWhereNothingIsTruncated) {
  for (const bool glossy : {false, true}) {
    TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), glossy), 18, 14);
    bench.parts = &bench.cache;
    const TransferBench::Knobs exact = {
        {"device", "cpu"}, {"weights", "float32"}, {"coefficients", "0"}, {"glossy_coefficients", "0"}};
    StageLog log;
    const Relit pixels = bench.prepare(exact)->relight(lighting, log);
    const Relit haar = bench.prepare(with(exact, {{"view_basis", "haar"}}))->relight(lighting, log);
    EXPECT_GT(test::norm(pixels.indirect), 0.0);
    EXPECT_LT(relative_difference(haar.indirect, pixels.indirect), 1e-5);
  }
}

// The point of it: as many coefficients in all, less error. Red if a tile's rows don't share their budget
// (tried: no more than 20 in any row) or keep the wrong ones.
TEST(ViewBasis, LosesLessToTruncationWithAsManyCoefficients) {
  TransferBench bench(tiny::room());
  bench.parts = &bench.cache;
  const TransferBench::Knobs cpu = {{"device", "cpu"}, {"weights", "float32"}};
  const TransferBench::Knobs few = with(cpu, {{"coefficients", "20"}});
  StageLog log;
  const Relit all = bench.prepare(with(cpu, {{"coefficients", "0"}}))->relight(lighting, log);
  const Relit pixels = bench.prepare(few)->relight(lighting, log);
  const int64_t pixels_kept = counter(bench.precompute_log, "non_zeros");
  const Relit haar = bench.prepare(with(few, {{"view_basis", "haar"}}))->relight(lighting, log);
  EXPECT_LE(counter(bench.precompute_log, "non_zeros"), pixels_kept);
  EXPECT_GT(counter(bench.precompute_log, "non_zeros"), pixels_kept * 99 / 100);
  EXPECT_LT(relative_difference(haar.indirect, all.indirect),
            0.6 * relative_difference(pixels.indirect, all.indirect));
}

// Thirty coefficients of one weight, of which a budget of 16 keeps those of the smallest columns: no fewer.
// Red if ties are dropped together (tried: only what is heavier than the heaviest that is not kept).
TEST(ViewBasis, KeepsItsBudgetAmongCoefficientsOfEqualWeight) {
  TransferBench bench(tiny::room(), 4, 4);
  FinalGatherSettings settings;
  settings.coefficients = 1;
  settings.support_exponent = 0.0f;
  const wavelet::PictureHaar basis(4, 4, {1});
  RowBuilder builder(bench.buffer, settings, MatrixPart::diffuse, 1024, 0.0f, &basis);
  std::vector<LaneCoefficient> spikes;  // each three fine details of 1/2, and four smaller coefficients
  for (uint32_t column = 1; column <= 10; ++column) spikes.push_back({column, Lanes{1.0f}});
  RowScratch scratch;
  builder.add(scratch, spikes, 0);
  const SparseRows rows = builder.finish();
  EXPECT_EQ(rows.entries.size(), 16u);
  for (const SparseEntry& e : rows.entries) {
    EXPECT_EQ(std::abs(e.value), 0.5f);
    EXPECT_LE(e.column, 6u);
  }
}

// 100 products and 5 Haar levels in float against double: 100 roundings of 2^-24, as without a basis.
TEST(ViewBasis, AllDevicesAndProductsAgree) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), true), 26, 18);
  const TransferBench::Knobs knobs = {{"view_basis", "haar"}, {"shadows", "traced"}, {"weights", "float32"}};
  StageLog log;
  const Relit oracle = bench.prepare(with(knobs, {{"device", "oracle"}}))->relight(lighting, log);
  for (const auto& [device, product] :
       {std::pair{"gpu", "rows"}, {"gpu", "tiles"}, {"gpu", "quads"}, {"cpu", "rows"}, {"cpu", "tiles"}}) {
    const Relit relit =
        bench.prepare(with(knobs, {{"device", device}, {"product", product}}))->relight(lighting, log);
    EXPECT_LT(relative_difference(relit.indirect, oracle.indirect), 6e-6) << device << " " << product;
  }
}

// Refitted, so that every part of the row builder is in it: of more candidates no more are kept than the
// budget (tried: a budget four times as large).
TEST(ViewBasis, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<Relit> results;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    TransferBench bench(tiny::room(), 18, 14);
    StageLog log;
    const auto prepared = bench.prepare({{"device", "cpu"},
                                         {"view_basis", "haar"},
                                         {"coefficients", "20"},
                                         {"refit_lights", "32"},
                                         {"refit_candidates", "1.5"}});
    EXPECT_LE(counter(bench.precompute_log, "non_zeros"), 18 * 14 * 20);
    results.push_back(prepared->relight(lighting, log));
  }
  const auto &a = results[0].total.pixels, &b = results[1].total.pixels;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0);
}

// Red if either knob is ignored without a word.
TEST(ViewBasis, RefusesBudgetsThatItDoesNotKnow) {
  TransferBench bench(tiny::room(), 8, 6);
  EXPECT_THROW(bench.prepare({{"view_basis", "haar"}, {"row_budget", "shared"}}), Error);
  EXPECT_THROW(bench.prepare({{"view_basis", "haar"}, {"energy_fraction", "0.9"}}), Error);
}

}  // namespace
}  // namespace relight::direct_to_indirect
