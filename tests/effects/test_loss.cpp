// The loss estimator on made-up replicates whose truth is known.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/image/noise_statistics.h"
#include "experiments/effects/loss.h"

namespace relight::test {
namespace {

// Two groups: 0 stays, 1 may be lost.
LightByGroup two_groups(int replicates, float kept, float lost, float noise, uint64_t seed, int side = 16) {
  std::mt19937_64 random(seed);
  std::gamma_distribution<float> unit(1.0f, 1.0f);  // mean 1, deviation 1: light is not negative and skewed
  LightByGroup light;
  light.width = light.height = side;
  for (int k = 0; k < replicates; ++k) {
    std::vector<Image> groups(2, Image(side, side));
    for (glm::vec3& p : groups[0].pixels) p = glm::vec3(kept);
    for (glm::vec3& p : groups[1].pixels) p = glm::vec3(lost * (1.0f - noise + noise * unit(random)));
    light.replicates.push_back(std::move(groups));
  }
  return light;
}

double true_loss(double kept, double lost) {
  const double whole = std::min(1.0, kept + lost);
  return (whole - std::min(1.0, kept)) / whole;
}

TEST(Loss, WithoutNoiseTheLossIsTheQuotientOfTheNorms) {
  const LightByGroup light = two_groups(8, 0.3f, 0.1f, 0.0f, 1);
  const LossEstimator estimator(light, {1, 1}, 1.0);
  const LossInterval loss = estimator.lost(std::vector<uint8_t>{0, 1});
  EXPECT_NEAR(loss.value, 0.25, 1e-6);
  EXPECT_NEAR(loss.low, loss.high, 1e-6);
  EXPECT_EQ(estimator.lost(std::vector<uint8_t>{0, 0}).high, 0.0);
}

// Red if lost light counts that the clamp hides (tried: without the excess).
TEST(Loss, LightAboveTheClampIsNotLost) {
  const LightByGroup light = two_groups(8, 0.8f, 0.4f, 0.0f, 1);
  const LossEstimator estimator(light, {1, 1}, 1.0);
  EXPECT_NEAR(estimator.lost(std::vector<uint8_t>{0, 1}).value, 0.2, 1e-6);
  const LossEstimator bright(light, {1, 1}, 2.0);
  EXPECT_EQ(bright.lost(std::vector<uint8_t>{0, 1}).high, 0.0);
  Image lacking(16, 16);
  for (glm::vec3& p : lacking.pixels) p = glm::vec3(0.3f);
  EXPECT_NEAR(estimator.lost(lacking).value, 0.1, 1e-6);
}

// The mean of noisy squares is larger than the square of the mean; products of different replicates aren't.
// Red if noise is not taken out (tried: |mean|^2 in place of the products), or twice.
TEST(Loss, NoiseDoesNotBiasTheSquaredLoss) {
  double sum = 0.0, squares = 0.0;
  constexpr int seeds = 400;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const LightByGroup light = two_groups(8, 1.0f, 0.01f, 1.0f, 100 + seed, 8);
    const double loss = LossEstimator(light, {1, 1}, 0.5).lost(std::vector<uint8_t>{0, 1}).value;
    sum += loss * loss, squares += std::pow(loss, 4);
  }
  const double mean = sum / seeds, error = std::sqrt((squares / seeds - mean * mean) / seeds);
  // The root is cut at zero, which 8 replicates of 64 pixels of this noise never reach.
  EXPECT_NEAR(mean, std::pow(true_loss(0.5, 0.005), 2), 4.0 * error);
  EXPECT_LT(error / mean, 0.02);
}

// Red if the interval is too narrow (tried: without the factor n - 1 of the jackknife), or so
// wide that it says nothing.
TEST(Loss, TheIntervalCoversTheTruthAsOftenAsItSays) {
  int covered = 0, too_high = 0;
  constexpr int seeds = 600;
  double width = 0.0;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const LightByGroup light = two_groups(8, 1.0f, 0.05f, 1.0f, 5000 + seed, 8);
    const LossInterval loss = LossEstimator(light, {1, 1}, 0.5).lost(std::vector<uint8_t>{0, 1});
    const double truth = true_loss(0.5, 0.025);
    covered += loss.low <= truth && truth <= loss.high;
    too_high += loss.high < truth;
    width += (loss.high - loss.low) / seeds;
  }
  // Binomial, four deviations: 95 % +- 3.6 %.
  EXPECT_NEAR(covered / double(seeds), 0.95, 0.036);
  EXPECT_LT(too_high / double(seeds), 0.06);
  // That of the mean of 8 x 64 values whose deviation is their mean, by Student's t.
  EXPECT_LT(width / true_loss(0.5, 0.025), 1.1 * 2.0 * student_quantile_95(7) / std::sqrt(512.0));
}

TEST(Loss, StudentsQuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_quantile_95(7), 2.3646, 2e-3);
  EXPECT_NEAR(student_quantile_95(15), 2.1314, 1e-3);
  EXPECT_NEAR(student_quantile_95(31), 2.0395, 1e-3);
}

}  // namespace
}  // namespace relight::test
