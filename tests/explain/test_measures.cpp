// The errors that waterfalls are made of, against hand-computed pictures and the program's metrics.
#include <cmath>

#include <gtest/gtest.h>

#include "common/image/metrics.h"
#include "common/run/error.h"
#include "common/sampling/random.h"
#include "experiments/explain/measures.h"

namespace relight::test {
namespace {

Image grey(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1);
  for (size_t i = 0; i < values.size(); ++i) image.pixels[i] = glm::vec3(values[i]);
  return image;
}

Picture grey_picture(const std::vector<float>& total, const std::vector<float>& indirect) {
  return {grey(total), grey(indirect)};
}

Picture random_picture(size_t pixels, uint64_t seed) {
  std::vector<float> total, indirect;
  for (uint64_t i = 0; i < pixels; ++i) {
    total.push_back(1.5f * random_float(seed, 0, i, 0));
    indirect.push_back(random_float(seed, 0, i, 1));
  }
  return grey_picture(total, indirect);
}

PictureLayout layout_of(size_t pixels, size_t pixels_a_block, float exposure = 1.0f) {
  PictureLayout layout;
  layout.exposure = exposure;
  layout.edge.assign(pixels, 0);
  for (size_t i = 0; i < pixels; ++i) layout.block.push_back(static_cast<int>(i / pixels_a_block));
  return layout;
}

// Exposure 2: A is clamped from 1.2 to 1 in pixel 0. Red if the clamp or the exposure is left out, edges
// count, or the linear measure is clamped (all four tried).
TEST(Measures, HaveTheValuesOfTheirFormulas) {
  const Picture a = grey_picture({0.6f, 0.1f, 0.3f}, {3.0f, 1.0f, 0.0f}),
                r = grey_picture({0.4f, 0.3f, 0.1f}, {2.0f, 1.0f, 2.0f});
  PictureLayout layout = layout_of(3, 1, 2.0f);
  layout.edge[2] = 1;
  const auto of = [&](Measure::Kind m) { return share(block_sums(a, r, r, layout, m)); };
  EXPECT_NEAR(of(Measure::relative), std::sqrt((0.04 + 0.16 + 0.16) / (0.64 + 0.36 + 0.04)), 1e-6);
  EXPECT_NEAR(of(Measure::relative_edges_out), std::sqrt((0.04 + 0.16) / (0.64 + 0.36)), 1e-6);
  EXPECT_NEAR(of(Measure::indirect_linear), std::sqrt((1.0 + 4.0) / 9.0), 1e-6);
}

// Red if the waterfall measured something else than `relight compare` does.
TEST(Measures, AreThoseOfTheErrorReport) {
  const Picture a = random_picture(64, 1), r = random_picture(64, 2);
  PictureLayout layout = layout_of(64, 16, 0.8f);
  for (size_t i = 0; i < 64; i += 5) layout.edge[i] = 1;
  const ErrorReport total = compare_images(a.total, r.total, {}, layout.edge, layout.exposure),
                    indirect = compare_images(a.indirect, r.indirect, {}, layout.edge, layout.exposure);
  const auto of = [&](Measure::Kind m) { return share(block_sums(a, r, r, layout, m)); };
  EXPECT_NEAR(of(Measure::relative), total.value.relative, 1e-9);
  EXPECT_NEAR(of(Measure::relative_edges_out), total.value.relative_edges_out, 1e-9);
  EXPECT_NEAR(of(Measure::indirect_linear), indirect.value.relative_hdr, 1e-9);
}

// Blocks of independent random errors: over many subsets the share must lie within its own interval of the
// share of all of them 95 % of the times. 200 subsets: 0.95 +- 0.05 is three standard deviations. Red if the
// jackknife's factor (n - 1) / n is taken as 1 / n or 1 / (n - 1), as for the variance of a mean (both
// tried).
TEST(Measures, IntervalsOverTheChoiceOfBlocksHoldWhatTheyPromise) {
  constexpr size_t blocks = 40, subsets = 200;
  const auto sums = [&](uint64_t subset) {
    BlockSums s;
    for (uint64_t b = 0; b < blocks; ++b) {
      s.reference.push_back(1.0 + static_cast<double>(random_float(7, subset, b, 0)));
      s.difference.push_back(0.02 * static_cast<double>(random_float(7, subset, b, 1)));
    }
    return s;
  };
  BlockSums all;
  for (uint64_t i = 0; i < subsets; ++i) {
    const BlockSums s = sums(i);
    all.difference.insert(all.difference.end(), s.difference.begin(), s.difference.end());
    all.reference.insert(all.reference.end(), s.reference.begin(), s.reference.end());
  }
  int within = 0;
  for (uint64_t i = 0; i < subsets; ++i) {
    const BlockSums s = sums(i);
    within += std::abs(share(s) - share(all)) <= half_width_of_drop(s, {});
  }
  EXPECT_NEAR(within / static_cast<double>(subsets), 0.95, 0.05);
}

// Two settings that err alike in every block differ by nothing, whichever blocks were chosen. Red if the
// widths of the two are added instead of that of the difference taken (tried).
TEST(Measures, ADropThatIsTheSameEverywhereIsCertain) {
  BlockSums a;
  for (uint64_t b = 0; b < 10; ++b) {
    a.reference.push_back(1.0);
    a.difference.push_back(static_cast<double>(random_float(3, 0, b, 0)));
  }
  EXPECT_GT(half_width_of_drop(a, {}), 0.1);
  EXPECT_NEAR(half_width_of_drop(a, a), 0.0, 1e-12);
}

TEST(Measures, RefusePicturesOfDifferentSizes) {
  const Picture a = random_picture(8, 1), b = random_picture(9, 1);
  EXPECT_THROW(block_sums(a, b, a, layout_of(8, 4), Measure::relative), Error);
  EXPECT_THROW(block_sums(a, a, a, layout_of(7, 4), Measure::relative), Error);
}

}  // namespace
}  // namespace relight::test
