// Against published tables and hand-computed values.
#include "experiments/stored_references/significance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace relight::test {
namespace {

// Student's t, two-sided 5 % quantile for 10 degrees of freedom is 2.228139, for 62 it is 1.998972.
TEST(WelchPValue, IsThatOfStudentsTables) {
  EXPECT_NEAR(welch_p_value({2.228139, 1.0, 11}, {0.0, 0.0, 32}), 0.05, 1e-6);
  // Equal variances and counts: n1 + n2 - 2 degrees of freedom.
  EXPECT_NEAR(welch_p_value({1.998972 * std::sqrt(2.0), 1.0, 32}, {0.0, 1.0, 32}), 0.05, 1e-6);
}

TEST(WelchPValue, OfExactNumbersIsZeroOrOne) {
  EXPECT_EQ(welch_p_value({3.0, 0.0, 32}, {3.0, 0.0, 32}), 1.0);
  EXPECT_EQ(welch_p_value({3.0, 0.0, 32}, {3.00001, 0.0, 32}), 1.0) << "rounding";
  EXPECT_EQ(welch_p_value({3.0, 0.0, 32}, {3.001, 0.0, 32}), 0.0);
  EXPECT_EQ(welch_p_value({0.0, 0.0, 32}, {0.0, 0.0, 32}), 1.0);
  EXPECT_EQ(welch_p_value({0.0, 0.0, 32}, {1e-9, 0.0, 32}), 0.0);
}

// Red if: a NaN, which is neither above nor below anything, passes for agreement.
TEST(WelchPValue, OfNaNIsZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(welch_p_value({nan, 1.0, 32}, {0.0, 1.0, 32}), 0.0);
  EXPECT_EQ(welch_p_value({0.0, nan, 32}, {0.0, 1.0, 32}), 0.0);
}

TEST(EquivalentSigmas, InvertsTheNormalDistribution) {
  EXPECT_NEAR(equivalent_sigmas(0.002699796), 3.0, 1e-6);
  EXPECT_NEAR(equivalent_sigmas(1.0), 0.0, 1e-12);
  EXPECT_TRUE(std::isfinite(equivalent_sigmas(0.0)));
}

// Three coins: P(X >= 2) = 4/8.
TEST(BinomialUpperTail, CountsCoins) {
  EXPECT_NEAR(binomial_upper_tail(2, 3, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(binomial_upper_tail(3, 3, 0.5), 0.125, 1e-12);
  EXPECT_EQ(binomial_upper_tail(0, 3, 0.5), 1.0);
  EXPECT_EQ(binomial_upper_tail(4, 3, 0.5), 0.0);
}

TEST(Sidak, LevelAndPValueAreInverse) {
  EXPECT_NEAR(sidak_p_value(0.5, 2), 0.75, 1e-12);
  EXPECT_NEAR(sidak_p_value(sidak_level(1e-4, 20736), 20736), 1e-4, 1e-12);
  EXPECT_NEAR(sidak_level(1e-4, 20736), 4.8228e-9, 1e-12) << "does not cancel";
  EXPECT_EQ(sidak_p_value(1.0, 5), 1.0);
}

}  // namespace
}  // namespace relight::test
