// The CPU's fast relight against its double-precision oracle, and lights that move one at a time.
#include <cstdio>
#include <cstring>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;
using test::TransferBench;

const Light lamp = tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(2.0f, 1.5f, 1.0f));
const Light beam = tiny::spot({-0.4f, 0.9f, 0.5f}, {0.2f, -1.0f, -0.1f}, 15.0f, 20.0f, glm::vec3(3.0f));

// With float weights both sides make the same sums, one in float, one in double, of some 100 products and 5
// Haar levels: 100 roundings of 2^-24. With 8 bits (the default) a weight is off by up to 2^-8 of the largest
// of its row or tile; such errors average out over a row, the bound is 1 %. Direct: same rays, same formulas.
// Red if blocks, albedos, rows or coefficients are mixed up.
TEST(TransferCpu, AgreesWithItsDoublePrecisionOracle) {
  for (const auto& [glossy, rows] : {std::pair(false, "closest"), {true, "closest"}, {true, "edges"}}) {
    TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), glossy));
    const std::pair<std::string, std::string> upsampling("upsampling", rows);
    const auto cpu = bench.prepare({{"device", "cpu"}, {"weights", "float32"}, upsampling});
    const auto quantised = bench.prepare({{"device", "cpu"}, upsampling});
    const auto oracle = bench.prepare({{"device", "oracle"}, {"shadows", "traced"}, upsampling});
    for (const LightingState& lighting :
         {tiny::lighting({lamp}), tiny::lighting({beam}), tiny::lighting({lamp, beam})}) {
      StageLog log;
      const Relit a = cpu->relight(lighting, log), b = oracle->relight(lighting, log);
      EXPECT_GT(test::norm(b.indirect), 0.0);
      EXPECT_LT(relative_difference(a.direct, b.direct), 6e-6);
      EXPECT_LT(relative_difference(a.indirect, b.indirect), 6e-6);
      EXPECT_LT(relative_difference(a.total, b.total), 6e-6);
      EXPECT_LT(relative_difference(quantised->relight(lighting, log).indirect, b.indirect), 0.01);
    }
  }
}

// Against a row for every sub-pixel; all links and coefficients, so that nothing else differs. Red if rows of
// their own go to other sub-pixels than those that match no pixel. Prints what `edges` leaves of the
// difference.
TEST(TransferCpu, RowsAtEdgesBringThePictureCloserToARowForEachSubpixel) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f)), 63, 45);
  std::vector<Image> indirect;
  for (const char* upsampling : {"closest", "edges", "none"}) {
    StageLog log;
    const auto prepared = bench.prepare({{"device", "cpu"},
                                         {"weights", "float32"},
                                         {"link_threshold", "0"},
                                         {"coefficients", "0"},
                                         {"upsampling", upsampling}});
    indirect.push_back(prepared->relight(tiny::lighting({lamp}), log).indirect);
  }
  const double closest = relative_difference(indirect[0], indirect[2]),
               edges = relative_difference(indirect[1], indirect[2]);
  std::printf("relative difference: closest %.4f edges %.4f\n", closest, edges);
  EXPECT_GT(closest, 0.002) << "else there is nothing to gain";
  EXPECT_LT(edges, 0.8 * closest);
}

// Red if a thread's share of the work shows.
TEST(TransferCpu, GivesTheSameBitsForAnyNumberOfThreads) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), true), 63, 45);
  std::vector<Relit> results;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    StageLog log;
    results.push_back(bench.prepare({{"device", "cpu"}})->relight(tiny::lighting({lamp, beam}), log));
  }
  const auto& a = results[0].total.pixels;
  EXPECT_EQ(std::memcmp(a.data(), results[1].total.pixels.data(), a.size() * sizeof(a[0])), 0);
}

// Red if shadow maps are asked for and traced shadows given without a word.
TEST(TransferCpu, RefusesShadowMaps) {
  TransferBench bench(tiny::room(), 8, 6);
  EXPECT_THROW(bench.prepare({{"device", "cpu"}, {"shadows", "map"}}), Error);
}

// One of four lights moves, stops, another one moves, one is switched off. Each picture equals one that
// starts afresh within the rounding of sums in another order: 4 lights x 2^-23 each, bound 1e-6. Red if the
// kept sum goes stale (tried: copy() left out; the sum not cleared when it starts again).
TEST(MovingLights, GiveThePictureOfAFreshRelightAndCostOneShading) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), true));
  for (const char* device : {"cpu", "gpu"}) {
    const auto kept = bench.prepare({{"device", device}, {"shadows", "traced"}});
    const auto fresh = bench.prepare({{"device", device}, {"shadows", "traced"}});
    LightingState lighting = tiny::lighting({lamp, beam, lamp, beam});
    lighting.lights[2].position.x = -0.3f;
    lighting.lights[3].position.x = 0.4f;
    std::vector<int64_t> shaded;
    for (int frame = 0; frame < 10; ++frame) {
      if (frame >= 1 && frame <= 4) lighting.lights[1].position.x += 0.03f;
      if (frame == 6 || frame == 7) lighting.lights[0].position.y -= 0.05f;
      if (frame == 8) lighting.lights[3].intensity = glm::vec3(0.0f);
      StageLog log, fresh_log;
      fresh->forget();
      const Relit a = kept->relight(lighting, log), b = fresh->relight(lighting, fresh_log);
      EXPECT_LT(relative_difference(a.total, b.total), 1e-6) << device << ", frame " << frame;
      shaded.push_back(log.counters().at("lights_shaded"));
      EXPECT_EQ(fresh_log.counters().at("lights_cached"), 0);
      EXPECT_EQ(fresh_log.counters().at("lights_shaded"), frame < 8 ? 4 : 3);
    }
    // Frame 1 gathers the others; frame 6 gathers anew without light 0; frame 8 starts again without light 3.
    EXPECT_EQ(shaded, (std::vector<int64_t>{4, 4, 1, 1, 1, 1, 4, 1, 3, 0})) << device;
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
