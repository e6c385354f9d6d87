// A few pixels computed alone, for explain-error: they are those of the whole picture, and cost their share
// of it.
#include <gtest/gtest.h>

#include <cstring>

#include "common/sampling/pixel_subset.h"
#include "tests/clustered_gather/gather_bench.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

using test::Knobs;

// Red if a view cluster that a wanted pixel takes light from is left out (tried: only those that the wanted
// pixels themselves link to, without the 3x3 upsampling; only each pixel's first link), or the cache takes
// the data of some pixels for those of all (tried: pixels left out of the key).
TEST(ClusteredGatherPixelsAlone, AreThoseOfTheWholePictureAndCostLess) {
  test::GatherBench bench(tiny::room(2.0f, glm::vec3(0.0f), true), 62, 45);
  const LightingState lighting = tiny::lighting({tiny::omni({0.2f, 0.4f, 0.7f})});
  const PixelSubset subset = choose_pixels(62, 45, 128, glm::ivec2(4), 1);
  const Knobs clustered = {
      {"device", "cpu"}, {"view_clusters", "300"}, {"directions", "64"}, {"gather_clusters", "12"}};
  const Knobs exact = {{"device", "cpu"},
                       {"view_clusters", "0"},
                       {"neighbours", "1"},
                       {"directions", "32"},
                       {"gather_clusters", "0"}};
  for (const Knobs& knobs : {clustered, exact}) {
    bench.buffer.wanted.clear();
    const Image whole = compact(bench.relight(knobs, lighting).total, subset);
    const int64_t rays = bench.precompute_log.counters().at("gather_rays");
    bench.buffer.wanted = pixel_mask(subset);
    const Image alone = compact(bench.relight(knobs, lighting).total, subset);
    EXPECT_EQ(std::memcmp(whole.pixels.data(), alone.pixels.data(), whole.pixels.size() * sizeof(glm::vec3)),
              0);
    EXPECT_LT(bench.precompute_log.counters().at("gather_rays"), rays * 3 / 4);
  }
}

}  // namespace
}  // namespace relight
