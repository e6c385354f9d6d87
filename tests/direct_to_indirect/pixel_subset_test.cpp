// A few pixels computed alone are those of the whole picture: only then does an error measured on them say
// anything.
#include <cstring>

#include <gtest/gtest.h>

#include "common/sampling/pixel_subset.h"
#include "common/scene/scene_file.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;
using test::TransferBench;

constexpr int width = 62, height = 45;  // cut tiles at both rims

struct Both {
  Image whole, alone;  // the same pixels
};

// The picture of some pixels, taken from the whole view and computed alone.
Both relit(TransferBench& bench, const TransferBench::Knobs& knobs, glm::ivec2 block) {
  const PixelSubset subset = choose_pixels(width, height, 256, block, 1);
  const LightingState& lighting = bench.scene.lightings.at("near");
  StageLog log;
  bench.buffer.wanted.clear();
  const Image whole = bench.prepare(knobs)->relight(lighting, log).total;
  bench.buffer.wanted = pixel_mask(subset);
  const Image alone = bench.prepare(knobs)->relight(lighting, log).total;
  return {compact(whole, subset), compact(alone, subset)};
}

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(a.pixels[0])) == 0;
}

// Red if anything is taken from the chosen pixels that belongs to the view (tried: importance from them; the
// shared budget's threshold from them), or rows are left out whose light a sub-pixel takes (tried: own pixels
// only).
TEST(PixelsAlone, AreThoseOfTheWholePictureBitForBitOnTheCpu) {
  TransferBench bench(load_scene("cornell"), width, height);
  for (const TransferBench::Knobs& knobs :
       {TransferBench::Knobs{},
        {{"refit_lights", "64"},
         {"refit_candidates", "1.5"},
         {"near_field", "hemisphere"},
         {"near_rays", "32"}},
        {{"column_scaling", "mean_row"}, {"row_budget", "shared"}, {"coefficients", "30"}},
        {{"upsampling", "none"}, {"link_members", "all"}, {"weights", "float32"}},
        {{"bounces", "3"}, {"photons", "20000"}, {"photon_neighbours", "100"}, {"product", "rows"}}}) {
    TransferBench::Knobs on_cpu = knobs;
    on_cpu.emplace_back("device", "cpu");
    const Both both = relit(bench, on_cpu, glm::ivec2(4));
    EXPECT_GT(test::norm(both.whole), 0.0);
    EXPECT_TRUE(same_bits(both.whole, both.alone)) << relative_difference(both.alone, both.whole);
  }
}

// On the GPU the default product shares the step of 8-bit weights among the 16x8 pixels of a screen tile:
// whole tiles have the same bits, and of 4x4 pixels alone the steps are finer, so the picture differs by less
// than the quantisation itself does (0.5 %). Red as above.
TEST(PixelsAlone, AreThoseOfTheWholePictureOnTheGpuInBlocksOfItsTiles) {
  TransferBench bench(load_scene("cornell"), width, height);
  EXPECT_TRUE(same_bits(relit(bench, {}, {16, 8}).whole, relit(bench, {}, {16, 8}).alone));
  const Both small = relit(bench, {}, glm::ivec2(4));
  EXPECT_LT(relative_difference(small.alone, small.whole), 5e-3);
  const Both floats = relit(bench, {{"weights", "float32"}}, glm::ivec2(4));
  EXPECT_TRUE(same_bits(floats.whole, floats.alone));
}

}  // namespace
}  // namespace relight::direct_to_indirect
