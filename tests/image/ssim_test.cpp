#include "common/image/ssim.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace relight {
namespace {

constexpr double c1 = 1e-4, c2 = 9e-4;

double value_of(const Plane& x, const Plane& y) { return structural_similarity(x, y, {}).value; }

Plane random_plane(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Plane plane{width, height, std::vector<double>(static_cast<size_t>(width * height))};
  for (double& value : plane.values) value = uniform(random);
  return plane;
}

// Equation 13 by its definition: one window at a time, two passes, no separable filter.
double definition(const Plane& x, const Plane& y) {
  double total = 0.0;
  for (int cy = 0; cy < x.height; ++cy)
    for (int cx = 0; cx < x.width; ++cx) {
      const auto sum_over_window = [&](auto value) {
        double sum = 0.0, weights = 0.0;
        for (int py = std::max(0, cy - 5); py <= std::min(x.height - 1, cy + 5); ++py)
          for (int px = std::max(0, cx - 5); px <= std::min(x.width - 1, cx + 5); ++px) {
            const double weight =
                std::exp(-((px - cx) * (px - cx) + (py - cy) * (py - cy)) / (2.0 * 1.5 * 1.5));
            sum += weight * value(static_cast<size_t>(py * x.width + px));
            weights += weight;
          }
        return sum / weights;
      };
      const double mx = sum_over_window([&](size_t i) { return x.values[i]; });
      const double my = sum_over_window([&](size_t i) { return y.values[i]; });
      const double vx = sum_over_window([&](size_t i) { return (x.values[i] - mx) * (x.values[i] - mx); });
      const double vy = sum_over_window([&](size_t i) { return (y.values[i] - my) * (y.values[i] - my); });
      const double cov = sum_over_window([&](size_t i) { return (x.values[i] - mx) * (y.values[i] - my); });
      total += (2 * mx * my + c1) * (2 * cov + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
    }
  return total / (x.width * x.height);
}

// Bug: equal images below 1 by a wrong constant in one factor.
TEST(Ssim, EqualImagesHaveOne) {
  const Plane x = random_plane(20, 13, 1);
  EXPECT_NEAR(value_of(x, x), 1.0, 1e-12);
}

// Bug: the luminance term; a window that reaches outside the image. One pixel has no variance:
// (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4) = 0.2501 / 0.3126.
TEST(Ssim, OnePixelHasTheLuminanceTermAlone) {
  EXPECT_NEAR(value_of({1, 1, {0.5}}, {1, 1, {0.25}}), 0.2501 / 0.3126, 1e-12);
  EXPECT_EQ(value_of({1, 1, {0.0}}, {1, 1, {0.0}}), 1.0);
}

// Bug: sign of the covariance lost. Two pixels swapped: weights 1/(1+g) and g/(1+g) with g = exp(-1/4.5) =
// 0.800737, so the means are 0.444672 and 0.555328, the variances p = 0.246939 and the covariance -p.
TEST(Ssim, SwappedPixelsAreNegativelySimilar) {
  const double p = 0.555328 * 0.444672, squares = 0.555328 * 0.555328 + 0.444672 * 0.444672;
  const double expected = (2 * p + c1) * (-2 * p + c2) / ((squares + c1) * (2 * p + c2));
  EXPECT_NEAR(expected, -0.97226, 1e-4);
  EXPECT_NEAR(value_of({2, 1, {0, 1}}, {2, 1, {1, 0}}), expected, 1e-5);
}

// Bug: swapped axes or strides, a window of the wrong size or width, border weights not normalised.
TEST(Ssim, EqualsItsDefinitionOnRandomImagesOfAllShapes) {
  const int sizes[][2] = {{1, 1}, {1, 30}, {30, 1}, {5, 5}, {23, 9}, {12, 17}};
  for (const auto& [width, height] : sizes) {
    const Plane x = random_plane(width, height, 1), y = random_plane(width, height, 2);
    EXPECT_NEAR(value_of(x, y), definition(x, y), 1e-10) << width << " x " << height;
  }
}

// Bug: a wrong derivative. Against central differences of the value: half width = 1.96 |slope| sd for one
// noisy pixel.
TEST(Ssim, HalfWidthIsTheSlopeTimesTheNoise) {
  const Plane x = random_plane(13, 14, 3), y = random_plane(13, 14, 4);
  for (const size_t at : {size_t{0}, size_t{70}, size_t{13 * 14 - 1}}) {
    Plane variance{13, 14, std::vector<double>(13 * 14, 0.0)};
    variance.values[at] = 1e-4;
    const double h = 1e-5;
    Plane up = y, down = y;
    up.values[at] += h, down.values[at] -= h;
    const double slope = (value_of(x, up) - value_of(x, down)) / (2.0 * h);
    EXPECT_NEAR(structural_similarity(x, y, variance).half_width, 1.959964 * std::abs(slope) * 1e-2, 1e-9)
        << at;
  }
}

}  // namespace
}  // namespace relight
