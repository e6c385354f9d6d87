// Noise floors and half widths against the experiment that defines them: many references with known noise.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/image/metric_fields.h"

namespace relight {
namespace {

constexpr int width = 24, height = 16, trials = 600;

// Smooth colours with a bright spot above white and a dark corner: every branch of the metrics takes part.
Image true_image() {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = static_cast<float>(x) / width, v = static_cast<float>(y) / height;
      image.at(x, y) = {0.1f + 0.7f * u, 0.1f + 0.5f * v, 0.1f + 0.3f * u * v};
      if (x > 18 && y > 11) image.at(x, y) = glm::vec3(3.0f);
    }
  return image;
}

Image noise_sigma(float scale) {
  Image sigma(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sigma.at(x, y) = scale * glm::vec3(0.01f, 0.02f, 0.015f) * (1.0f + static_cast<float>(x % 3));
  return sigma;
}

struct Statistics {
  double sum = 0, squares = 0, magnitudes = 0, floors = 0, half_widths = 0;
  double mean() const { return sum / trials; }
  double sd() const {
    return std::sqrt(std::max(squares / trials - mean() * mean(), 0.0) * trials / (trials - 1));
  }
};

std::array<Statistics, std::size(metric_fields)> run_trials(const Image& a, const Image& truth,
                                                            float noise_scale) {
  std::mt19937_64 random(7);
  std::normal_distribution<float> normal;
  const Image sigma = noise_sigma(noise_scale);
  Image variance = sigma;
  for (auto& pixel : variance.pixels) pixel *= pixel;
  std::vector<uint8_t> edge(truth.pixels.size());
  for (size_t i = 0; i < edge.size(); ++i) edge[i] = i % 5 == 0;
  std::array<Statistics, std::size(metric_fields)> statistics;
  for (int trial = 0; trial < trials; ++trial) {
    Image noisy = truth;
    for (size_t i = 0; i < noisy.pixels.size(); ++i) noisy.pixels[i] += normal(random) * sigma.pixels[i];
    const ErrorReport report = compare_images(a, noisy, variance, edge, 1.0f);
    for (size_t m = 0; m < std::size(metric_fields); ++m) {
      const double value = report.value.*metric_fields[m].second;
      Statistics& s = statistics[m];
      s.sum += value, s.squares += value * value, s.magnitudes += std::abs(value);
      s.floors += report.noise_floor.*metric_fields[m].second;
      s.half_widths += report.half_width.*metric_fields[m].second;
    }
  }
  return statistics;
}

// Bug: a factor 2 or a forgotten root in a floor, variance taken for standard deviation, clamped noise
// counted. Allowed: four standard errors of the experiment plus 2 % of the metric for the stated
// approximations (ssim: of its loss; 10 %, because expectations of quotients are taken as quotients of
// expectations).
TEST(MetricNoise, FloorIsTheMeanMetricOfANoiseFreeImage) {
  const Image truth = true_image();
  const auto statistics = run_trials(truth, truth, 1.0f);
  for (size_t m = 0; m < std::size(metric_fields); ++m) {
    const Statistics& s = statistics[m];
    const std::string name = metric_fields[m].first;
    const double measured = name == "bias" ? s.magnitudes / trials : s.mean(), floor = s.floors / trials;
    const double size = name == "ssim" ? 0.1 * (1.0 - measured) : 0.02 * measured;
    EXPECT_NEAR(floor, measured, 4.0 * s.sd() / std::sqrt(trials) + size) << name;
  }
}

// Bug: half widths of one standard deviation, variance of the sum instead of the root, slope without its
// noise. A is brighter than the truth by 20 % with a pattern. The experiment's own sd is known to 1 / sqrt(2
// * 600) = 3 %.
TEST(MetricNoise, HalfWidthIsTheSpreadOfAWrongImage) {
  Image a = true_image();
  for (size_t i = 0; i < a.pixels.size(); ++i) a.pixels[i] *= i % 2 ? 1.3f : 1.1f;
  const auto statistics = run_trials(a, true_image(), 0.3f);
  for (size_t m = 0; m < std::size(metric_fields); ++m) {
    const Statistics& s = statistics[m];
    // The largest of many similar differences spreads less than any one of them; its half width is a bound.
    const double least = std::string(metric_fields[m].first) == "max" ? 0.5 : 0.85;
    EXPECT_GT(1.96 * s.sd() / (s.half_widths / trials), least) << metric_fields[m].first;
    EXPECT_LT(1.96 * s.sd() / (s.half_widths / trials), 1.15) << metric_fields[m].first;
  }
}

// Bug: the chi-square part counted twice (ratio 0.71) or not at all. For ssim and max the width is an upper
// bound.
TEST(MetricNoise, HalfWidthOfANoiseFreeImageIsTheChiSquareSpread) {
  const Image truth = true_image();
  const auto statistics = run_trials(truth, truth, 0.3f);
  for (size_t m = 0; m < std::size(metric_fields); ++m) {
    const Statistics& s = statistics[m];
    const std::string name = metric_fields[m].first;
    const double least = name == "ssim" || name == "max" ? 0.3 : 0.85;
    EXPECT_GT(1.96 * s.sd() / (s.half_widths / trials), least) << name;
    EXPECT_LT(1.96 * s.sd() / (s.half_widths / trials), 1.15) << name;
  }
}

}  // namespace
}  // namespace relight
