#include "common/image/noise_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relight {
namespace {

// Bug: sqrt of the expected sum instead of the expected sqrt: 25 % too large for one value.
TEST(NoiseStatistics, ExpectedNormIsExactForEqualVariances) {
  // E |sigma z| = sigma sqrt(2/pi).
  EXPECT_NEAR(expected_norm(9.0, 81.0), 3.0 * std::sqrt(2.0 / M_PI), 1e-12);
  // Two values: Rayleigh distribution, sigma sqrt(pi/2).
  EXPECT_NEAR(expected_norm(2 * 9.0, 2 * 81.0), 3.0 * std::sqrt(M_PI / 2.0), 1e-12);
  // Three values: Maxwell distribution, 2 sigma sqrt(2/pi).
  EXPECT_NEAR(expected_norm(3 * 9.0, 3 * 81.0), 6.0 * std::sqrt(2.0 / M_PI), 1e-12);
}

// Bug: lgamma cancels or overflows for an image's number of pixels; a jump where the series takes over.
TEST(NoiseStatistics, ExpectedNormOfManyValuesNearsTheRootOfTheSum) {
  EXPECT_NEAR(expected_norm(999'999.0, 999'999.0), expected_norm(1'000'001.0, 1'000'001.0), 2e-3);
  EXPECT_NEAR(expected_norm(1e12, 1e12) / 1e6, 1.0, 1e-12);
  EXPECT_EQ(expected_norm(0.0, 0.0), 0.0);
}

// Bug: 0/0 for a pixel without noise; wrong quantile function.
TEST(NoiseStatistics, ExpectedMaximumMatchesClosedForms) {
  // The integral's step and 500 points give four digits.
  EXPECT_NEAR(expected_maximum({2.0}), 2.0 * std::sqrt(2.0 / M_PI), 1e-3);
  // max(|x|,|y|) = (|x+y| + |x-y|) / 2, whose mean is 2/sqrt(pi).
  EXPECT_NEAR(expected_maximum({1.0, 1.0}), 2.0 / std::sqrt(M_PI), 1e-3);
  EXPECT_NEAR(expected_maximum({0.0, 0.0, 1.0}), std::sqrt(2.0 / M_PI), 1e-3);
  EXPECT_EQ(expected_maximum({0.0}), 0.0);
  EXPECT_EQ(expected_maximum({}), 0.0);
}

// Bug: only the largest sigma counts, or many small ones count like it.
TEST(NoiseStatistics, SmallNoiseBesideLargeHardlyRaisesTheMaximum) {
  std::vector<double> sigmas(1000, 0.01);
  sigmas.push_back(1.0);
  const double alone = expected_maximum({1.0});
  EXPECT_GE(expected_maximum(sigmas), alone);
  EXPECT_LE(expected_maximum(sigmas), alone + 0.01);
}

// Bug: 1.96 sd / (2 sqrt q) divides by 0 where the measured error is 0.
TEST(NoiseStatistics, RootHalfWidthIsFirstOrderForSmallVariancesAndFiniteAtZero) {
  EXPECT_NEAR(root_half_width(4.0, 1e-8), 1.959964e-4 / 4.0, 1e-9);
  EXPECT_NEAR(root_half_width(0.0, 1.0), 0.5 * std::sqrt(1.959964), 1e-6);
  EXPECT_EQ(root_half_width(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace relight
