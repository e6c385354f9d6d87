// The arithmetic of the waterfall on random pictures.
#include <cmath>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "experiments/explain/waterfall.h"

namespace relight::test {
namespace {

constexpr int pixels = 48;

Image random_image(uint64_t seed) {
  Image image(pixels, 1);
  for (uint64_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = random_float(seed, 1, i, static_cast<uint64_t>(c));
  return image;
}

SettingResult random_result(uint64_t seed) {
  return {{random_image(seed), random_image(seed + 100)},
          static_cast<double>(seed),
          10.0 * static_cast<double>(seed)};
}

ErrorStage stage(const std::string& name, bool active = true) { return {name, "A sentence.", {}, active}; }

// Three active stages and one that is not, all pictures unrelated.
WaterfallInput random_input() {
  WaterfallInput in;
  in.asked = random_result(1);
  in.stages = {{stage("first"), random_result(2), random_result(3)},
               {stage("idle", false), {}, {}},
               {stage("second"), random_result(4), random_result(5)},
               {stage("third"), random_result(6), random_result(7)}};
  in.remainder = "the rest";
  in.reference = random_result(8).picture;
  in.layout.edge.assign(pixels, 0);
  for (int i = 0; i < pixels; ++i) in.layout.block.push_back(i / 8);
  in.layout.edge[5] = in.layout.edge[17] = 1;
  return in;
}

// Red if a stage is compared with the method as asked instead of with the stage before it, or the remainder
// with another picture than the last (both tried).
TEST(Waterfall, PointsAddUpToTheErrorAsAskedInEveryMeasure) {
  const Waterfall waterfall = make_waterfall(random_input());
  const Measures sum = sum_of_points(waterfall);
  for (size_t m = 0; m < measure_count; ++m) {
    EXPECT_GT(waterfall.asked[m], 0.1);
    EXPECT_NEAR(sum[m], waterfall.asked[m], 1e-12) << measure_names()[m];
  }
}

// Red if times are taken from the wrong neighbours (tried: always against the method as asked).
TEST(Waterfall, SavingsAreThoseAgainstTheStageBefore) {
  const Waterfall waterfall = make_waterfall(random_input());
  EXPECT_DOUBLE_EQ(*waterfall.stages[0].precompute_saved_s, 2.0 - 1.0);
  EXPECT_DOUBLE_EQ(*waterfall.stages[2].precompute_saved_s, 4.0 - 2.0);
  EXPECT_DOUBLE_EQ(*waterfall.stages[3].relight_saved_ms, 60.0 - 40.0);
  EXPECT_FALSE(waterfall.stages[1].precompute_saved_s);
}

TEST(Waterfall, AStageThatIsNotActiveCostsNothing) {
  const Waterfall waterfall = make_waterfall(random_input());
  EXPECT_FALSE(waterfall.stages[1].active);
  for (size_t m = 0; m < measure_count; ++m) EXPECT_EQ(waterfall.stages[1].points[m], 0.0);
}

// Only the second stage errs, and everything else is the reference: alone and in the chain it has all of the
// error, the others none. Red if `alone` is taken against the method as asked (tried), or |A - A_n| against a
// neighbour.
TEST(Waterfall, AloneColumnBlamesTheStageThatErrs) {
  WaterfallInput in = random_input();
  const SettingResult right = {in.reference, 0, 0}, wrong = random_result(20);
  in.asked = wrong;
  in.stages[0].exact = wrong, in.stages[0].alone = right;
  in.stages[2].exact = right, in.stages[2].alone = wrong;
  in.stages[3].exact = right, in.stages[3].alone = right;
  const Waterfall waterfall = make_waterfall(in);
  for (size_t m = 0; m < measure_count; ++m) {
    for (const size_t innocent : {0u, 3u}) {
      EXPECT_EQ(waterfall.stages[innocent].points[m], 0.0);
      EXPECT_EQ(waterfall.stages[innocent].alone_points[m], 0.0);
      EXPECT_EQ(waterfall.stages[innocent].alone_change[m], 0.0);
    }
    EXPECT_EQ(waterfall.stages[2].points[m], waterfall.asked[m]);
    EXPECT_EQ(waterfall.stages[2].alone_points[m], waterfall.asked[m]);
    EXPECT_EQ(waterfall.stages[2].alone_change[m], waterfall.asked[m]);
    EXPECT_EQ(waterfall.remainder.points[m], 0.0);
  }
}

// Two stages that undo each other: no error in all, but each changes the picture. Red if `change` is a
// difference of norms (tried).
TEST(Waterfall, ChangeShowsAStageThatMovesThePictureWithoutItsError) {
  WaterfallInput in = random_input();
  for (Image* image : {&in.reference.total, &in.reference.indirect})
    for (glm::vec3& p : image->pixels) p = glm::vec3(0.5f);
  SettingResult above = {in.reference, 0, 0}, below = above;
  for (size_t i = 0; i < pixels; ++i) {
    above.picture.total.pixels[i] += 0.1f, above.picture.indirect.pixels[i] += 0.1f;
    below.picture.total.pixels[i] -= 0.1f, below.picture.indirect.pixels[i] -= 0.1f;
  }
  in.asked = above;
  in.stages[0].exact = below;
  const Waterfall waterfall = make_waterfall(in);
  EXPECT_NEAR(waterfall.stages[0].points[Measure::relative], 0.0, 1e-6);
  EXPECT_NEAR(waterfall.stages[0].change[Measure::relative], 0.4, 1e-6);
}

TEST(Waterfall, RefusesABlackReference) {
  WaterfallInput in = random_input();
  in.reference.total = in.reference.indirect = Image(pixels, 1);
  EXPECT_THROW(make_waterfall(in), Error);
}

}  // namespace
}  // namespace relight::test
