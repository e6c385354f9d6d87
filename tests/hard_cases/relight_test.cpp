// Lights and views at which a relight could divide by zero, lose its cone or find nothing to light. Stated
// bound for all of them: every pixel finite, nothing replaced, and the fast CPU path within 6e-6 of the
// picture of the double-precision oracle (100 roundings of 2^-24; see transfer_cpu_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight {
namespace {

using test::relative_difference;
using test::TransferBench;

bool all_finite(const Image& image) {
  for (const glm::vec3& p : image.pixels)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

// Relights on both devices; returns the CPU's picture.
Relit relit_by_both(TransferBench& bench, const Light& light) {
  StageLog cpu_log, oracle_log;
  const LightingState lighting = tiny::lighting({light});
  Relit cpu = bench.prepare({{"device", "cpu"}, {"weights", "float32"}})->relight(lighting, cpu_log);
  const Relit oracle =
      bench.prepare({{"device", "oracle"}, {"shadows", "traced"}})->relight(lighting, oracle_log);
  EXPECT_TRUE(all_finite(cpu.total) && all_finite(oracle.total));
  EXPECT_TRUE(cpu_log.warnings().empty() && oracle_log.warnings().empty());
  EXPECT_LE(relative_difference(cpu.direct, oracle.direct), 6e-6);
  EXPECT_LE(relative_difference(cpu.indirect, oracle.indirect), 6e-6);
  return cpu;
}

// Red if a quad without samples lights up, or a miss takes a neighbour's indirect light.
TEST(RelightHardCases, BackgroundStaysBlackBesideAThinStripOfScene) {
  TransferBench bench([] {
    Scene scene = tiny::room();
    scene.camera.target += glm::vec3(2.75f, 0.0f, 0.0f);  // the room ends in the leftmost pixels
    finish_scene(scene);
    return scene;
  }());
  const Relit relit = relit_by_both(bench, tiny::omni({0.0f, 0.2f, 0.6f}));
  size_t background = 0, lit = 0;
  for (size_t i = 0; i < relit.total.pixels.size(); ++i) {
    const size_t x = i % 40, y = i / 40;
    bool hit = bench.buffer.indirect[i].valid;
    for (size_t s = 0; s < 4; ++s)
      hit = hit || bench.buffer.direct[(2 * y + s / 2) * 80 + 2 * x + s % 2].valid;
    background += !hit;
    const bool black = relit.total.pixels[i] == glm::vec3(0.0f);
    EXPECT_TRUE(hit || black) << x << ' ' << y;
    lit += !black;
  }
  EXPECT_GT(background, 800u);
  EXPECT_GT(lit, 10u);
}

TEST(RelightHardCases, ABlackLightGivesABlackPictureWithoutAnyRay) {
  TransferBench bench(tiny::room());
  StageLog log;
  const Light black = tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(0.0f));
  const Relit relit = bench.prepare({{"device", "cpu"}})->relight(tiny::lighting({black}), log);
  EXPECT_EQ(test::norm(relit.total), 0.0);
  EXPECT_EQ(log.counters().at("lights_shaded"), 0);
  EXPECT_EQ(log.counters().count("shadow_rays"), 0u);
}

// The block of the room is closed: a light inside reaches nothing that the camera sees. Red if rays start on
// the wrong side of a surface (tried: the offset's sign turned).
TEST(RelightHardCases, ALightInsideASolidGivesABlackPicture) {
  TransferBench bench(tiny::room());
  const Relit relit = relit_by_both(bench, tiny::omni({-0.3f, -0.5f, -0.3f}));
  EXPECT_EQ(test::norm(relit.direct), 0.0);
}

// Exactly at a sample of the view, and 1e-5 above one. Red if 0/0 or overflow reaches the picture.
TEST(RelightHardCases, ALightAtASampleIsFinite) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), true));
  const SurfaceSample& s = bench.buffer.direct[41 * 80 + 33];
  ASSERT_TRUE(s.valid);
  relit_by_both(bench, tiny::omni(s.position));
  EXPECT_GT(test::norm(relit_by_both(bench, tiny::omni(s.position + 1e-5f * s.geometric_normal)).direct),
            0.0);
}

// Full opening 0.1 degrees (cosines of inner and outer cone differ by a few roundings) and 179 degrees. Red
// if culling works with the angle's rounded cosine as if it were exact.
TEST(RelightHardCases, ConesOfATenthOfADegreeAndOf179DegreesLightWhatTheyShould) {
  TransferBench bench(tiny::room());
  const glm::vec3 position(0.5f, 0.9f, 0.2f);
  const SurfaceSample& target = bench.buffer.direct[47 * 80 + 40];
  ASSERT_TRUE(target.valid);
  const Light needle = tiny::spot(position, target.position - position, 0.02f, 0.05f, glm::vec3(100.0f));
  const Relit thin = relit_by_both(bench, needle);
  EXPECT_GT(test::norm(thin.direct), 0.0);
  // Every pixel has between the least and the largest of its four sub-samples' shares of the omni's light.
  const Light wide = tiny::spot(position, {0, -1, 0}, 60.0f, 89.5f), omni = tiny::omni(position);
  const Image by_spot = relit_by_both(bench, wide).direct, by_omni = relit_by_both(bench, omni).direct;
  size_t partly = 0;
  for (size_t i = 0; i < by_spot.pixels.size(); ++i) {
    float least = 1.0f, largest = 0.0f;
    for (size_t s = 0; s < 4; ++s) {
      const SurfaceSample& sample = bench.buffer.direct[(2 * (i / 40) + s / 2) * 80 + 2 * (i % 40) + s % 2];
      const float share =
          sample.valid ? shader::light_intensity(wide.params(), glm::normalize(sample.position - position)).x
                       : 0.0f;
      least = std::min(least, share), largest = std::max(largest, share);
    }
    const float full = by_omni.pixels[i].x, lit = by_spot.pixels[i].x;
    EXPECT_GE(lit, least * full - 1e-5f * full) << i;
    EXPECT_LE(lit, largest * full + 1e-5f * full) << i;
    partly += least > 0.05f && largest < 0.95f && full > 0.0f;
  }
  EXPECT_GT(partly, 20u);
}

}  // namespace
}  // namespace relight
