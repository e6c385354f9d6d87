#include "common/image/metrics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/run/error_message.h"

namespace relight {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Image grey_row(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1);
  for (size_t i = 0; i < values.size(); ++i) image.pixels[i] = glm::vec3(values[i]);
  return image;
}

ErrorReport compare(const Image& a, const Image& r, float exposure = 1.0f) {
  return compare_images(a, r, {}, {}, exposure);
}

void expect_all_nan(const MetricSet& m) {
  for (const double value :
       {m.relative, m.relative_edges_out, m.relative_hdr, m.rmse, m.relmse, m.bias, m.ssim, m.max})
    EXPECT_TRUE(std::isnan(value)) << value;
}

// A = (0.3, 0.6), R = (0.2, 0.4), exposure 2. Tolerances: 0.1f is not 0.1.
// Exposed and clamped: A = (0.6, 1), R = (0.4, 0.8), differences (0.2, 0.2).
// Bug: denominator not squared, mean and sum mixed up, exposure on one image only, clamp before exposure.
TEST(Metrics, EqualTheirFormulasOnTwoPixels) {
  const MetricSet m = compare(grey_row({0.3f, 0.6f}), grey_row({0.2f, 0.4f}), 2.0f).value;
  EXPECT_NEAR(m.relative, std::sqrt((0.04 + 0.04) / (0.16 + 0.64)), 1e-6);
  EXPECT_NEAR(m.relative_hdr, std::sqrt((0.01 + 0.04) / (0.04 + 0.16)), 1e-6);
  EXPECT_NEAR(m.rmse, std::sqrt((0.01 + 0.04) / 2), 1e-6);
  EXPECT_NEAR(m.relmse, (0.01 / 0.05 + 0.04 / 0.17) / 2, 1e-6);
  EXPECT_NEAR(m.bias, (0.45 - 0.3) / 0.3, 1e-6);
  EXPECT_NEAR(m.max, 0.2, 1e-6);
}

// R = (0.5, 0.25, 0), A = (0.5, 0.5, 0.1): differences 0, 0.25, 0.1. Bug: a channel left out or averaged
// first.
TEST(Metrics, CountChannelsApart) {
  Image a(1, 1, {0.5f, 0.5f, 0.1f}), r(1, 1, {0.5f, 0.25f, 0.0f});
  const MetricSet m = compare(a, r).value;
  EXPECT_NEAR(m.relative, std::sqrt(0.0725 / 0.3125), 1e-6);
  EXPECT_NEAR(m.rmse, std::sqrt(0.0725 / 3), 1e-6);
  EXPECT_NEAR(m.relmse, (0.0625 / 0.0725 + 0.01 / 0.01) / 3, 1e-5);
  EXPECT_NEAR(m.bias, 0.35 / 0.75, 1e-6);
  EXPECT_NEAR(m.max, 0.25, 1e-6);
  // Luminance 0.2126 * 0.5 + 0.7152 * 0.5 + 0.0722 * 0.1 = 0.47112 and 0.2126 * 0.5 + 0.7152 * 0.25 = 0.2851.
  EXPECT_NEAR(m.ssim, (2 * 0.47112 * 0.2851 + 1e-4) / (0.47112 * 0.47112 + 0.2851 * 0.2851 + 1e-4), 1e-6);
}

// Bug: too bright pixels count beyond white; the HDR metric clamps too.
TEST(Metrics, ClampMakesPixelsAboveWhiteEqual) {
  const MetricSet m = compare(grey_row({5.0f, 0.5f}), grey_row({2.0f, 0.5f})).value;
  EXPECT_EQ(m.relative, 0.0);
  EXPECT_EQ(m.ssim, 1.0);
  EXPECT_NEAR(m.relative_hdr, 3.0 / std::sqrt(4.25), 1e-6);
}

// Bug: the sign of the bias. A = R / 2.
TEST(Metrics, BiasOfADarkerImageIsNegative) {
  EXPECT_NEAR(compare(grey_row({0.1f, 0.3f}), grey_row({0.2f, 0.6f})).value.bias, -0.5, 1e-6);
}

// Bug: the mask inverted, or edges also left out of the other metrics.
TEST(Metrics, EdgePixelsAreLeftOutOfOneMetricOnly) {
  const Image a = grey_row({0.5f, 0.9f, 0.3f, 0.2f}), r = grey_row({0.4f, 0.1f, 0.3f, 0.2f});
  const ErrorReport report = compare_images(a, r, {}, {0, 1, 0, 0}, 1.0f);
  EXPECT_EQ(report.edge_share, 0.25);
  EXPECT_NEAR(report.value.relative_edges_out, std::sqrt(0.01 / (0.16 + 0.09 + 0.04)), 1e-6);
  EXPECT_NEAR(report.value.relative, std::sqrt(0.65 / 0.30), 1e-5);
  EXPECT_TRUE(std::isnan(compare_images(a, r, {}, {1, 1, 1, 1}, 1.0f).value.relative_edges_out));
}

// Bug: 0/0.
TEST(Metrics, BlackReferenceHasADefinedAnswer) {
  const Image black = grey_row({0.0f, 0.0f}), grey = grey_row({0.0f, 0.1f});
  const MetricSet equal = compare(black, black).value, wrong = compare(grey, black).value;
  EXPECT_EQ(equal.relative, 0.0);
  EXPECT_EQ(equal.relative_hdr, 0.0);
  EXPECT_EQ(equal.bias, 0.0);
  EXPECT_EQ(equal.ssim, 1.0);
  EXPECT_EQ(wrong.relative, infinity);
  EXPECT_EQ(wrong.relative_hdr, infinity);
  EXPECT_EQ(wrong.bias, infinity);
  EXPECT_NEAR(wrong.relmse, 0.5, 1e-6) << "0.01 / 0.01 at one of two pixels";
}

// Bug: std::max and comparisons that skip NaN report an error of 0.
TEST(Metrics, OneNonFinitePixelMakesEveryMetricNan) {
  for (const float bad : {nan, infinity, -infinity}) {
    const Image good = grey_row({0.1f, 0.2f, 0.3f}), broken = grey_row({0.1f, bad, 0.3f});
    for (const auto& report : {compare(broken, good), compare(good, broken)}) {
      EXPECT_EQ(report.non_finite, 1);
      expect_all_nan(report.value);
      expect_all_nan(report.noise_floor);
      expect_all_nan(report.half_width);
    }
  }
  EXPECT_EQ(compare(grey_row({nan, 1.0f}), grey_row({nan, nan})).non_finite, 2) << "pixels, not values";
}

// Bug: a broken variance hides behind a small floor, or spoils the metrics that do not need it.
TEST(Metrics, BrokenVarianceMakesFloorsNanButNotValues) {
  const Image a = grey_row({0.1f, 0.2f}), r = grey_row({0.1f, 0.3f});
  for (const float bad : {nan, infinity, -1e-9f}) {
    const ErrorReport report = compare_images(a, r, grey_row({0.01f, bad}), {}, 1.0f);
    expect_all_nan(report.noise_floor);
    expect_all_nan(report.half_width);
    EXPECT_NEAR(report.value.rmse, 0.1 / std::sqrt(2.0), 1e-6);
  }
}

// Bug: reading past the smaller image.
TEST(Metrics, SizesThatDifferFailWithBothSizes) {
  const Image small(2, 3), large(3, 2);
  EXPECT_EQ(error_message([&] { compare(small, large); }),
            "can't compare an image of 2 x 3 pixels with a reference of 3 x 2");
  EXPECT_THROW(compare_images(small, small, large, {}, 1.0f), Error);
  EXPECT_THROW(compare_images(small, small, {}, std::vector<uint8_t>(5), 1.0f), Error);
  EXPECT_THROW(compare(Image(), Image()), Error);
  EXPECT_THROW(compare(small, small, 0.0f), Error);
  EXPECT_THROW(compare(small, small, nan), Error);
}

// Bug: a floor that is not 0 without noise.
TEST(Metrics, WithoutVarianceTheReferenceIsExact) {
  const ErrorReport report = compare(grey_row({0.1f, 0.2f}), grey_row({0.1f, 0.3f}));
  EXPECT_EQ(report.noise_floor.relative, 0.0);
  EXPECT_EQ(report.noise_floor.max, 0.0);
  EXPECT_EQ(report.noise_floor.ssim, 1.0);
  EXPECT_EQ(report.half_width.relative, 0.0);
  EXPECT_EQ(report.half_width.ssim, 0.0);
}

// Two grey pixels R = (0.4, 2), sigma = 0.01 each, exposure 1: the second is clamped, so only the first has
// noise. relmse: second derivatives of 1 / (R^2 + 0.01): 191.33 and 0.3719, times 1e-8 / 2: 9.585e-7.
// relative: one z with s = 3 * 1e-4, E = sqrt(s) sqrt(2/pi), |R|^2 = 3 (0.16 + 1). Bug: noise of
// clamped pixels counted; channels taken as independent pixels.
TEST(Metrics, ClampedPixelsHaveNoNoise) {
  const Image r = grey_row({0.4f, 2.0f});
  const ErrorReport report = compare_images(r, r, grey_row({1e-4f, 1e-4f}), {}, 1.0f);
  EXPECT_NEAR(report.noise_floor.relative, std::sqrt(3e-4 * 2.0 / M_PI / 3.48), 1e-6);
  EXPECT_NEAR(report.noise_floor.relmse, (1e-4 / 0.17 + 1e-4 / 4.01) / 2 + 9.585e-7, 1e-9);
  // sd of the sum over channels and pixels: sqrt(2) * 3 * 0.01; of R: 7.2.
  EXPECT_NEAR(report.noise_floor.bias, std::sqrt(2.0 / M_PI) * std::sqrt(2.0) * 0.03 / 7.2, 1e-8);
}

}  // namespace
}  // namespace relight
