#include "common/image/false_colour.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/run/error.h"

namespace relight {
namespace {

double luminance(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// Bug: a wrong or swapped table entry: the eye would see a larger difference as smaller.
TEST(FalseColour, LargerDifferencesAreBrighter) {
  for (int i = 1; i <= 200; ++i)
    EXPECT_GT(luminance(false_colour(i / 200.0)), luminance(false_colour((i - 1) / 200.0))) << i;
}

// Bug: colours returned sRGB-encoded, or an end never reached. Yellow 0xfd = 253/255 is 0.9823 linear.
TEST(FalseColour, EndsAreVioletAndYellowInLinearLight) {
  EXPECT_NEAR(false_colour(1.0).x, 0.9823, 1e-3);
  EXPECT_NEAR(false_colour(1.0).z, 0.0185, 1e-3);
  EXPECT_NEAR(false_colour(0.0).z, 0.0887, 1e-3);
  EXPECT_EQ(false_colour(7.0), false_colour(1.0));
  EXPECT_EQ(false_colour(-1.0), false_colour(0.0));
  EXPECT_EQ(false_colour(std::numeric_limits<double>::quiet_NaN()), glm::vec3(1, 0, 1));
}

// Bug: signed differences cancel between channels. |A-R| = (0.3, 0.3, 0) has mean 0.2.
TEST(FalseColour, DifferenceIsTheMeanMagnitudeOverFullScale) {
  const Image a(1, 1, {0.5f, 0.2f, 0.1f}), r(1, 1, {0.2f, 0.5f, 0.1f});
  const glm::vec3 colour = difference_image(a, r, 0.4).pixels[0], expected = false_colour(0.5);
  EXPECT_NEAR(colour.x, expected.x, 1e-5);
  EXPECT_NEAR(colour.y, expected.y, 1e-5);
  EXPECT_THROW(difference_image(a, Image(2, 1), 0.4), Error);
  EXPECT_THROW(difference_image(a, r, 0.0), Error);
}

// Bug: one bright pixel, NaN or infinity sets the scale of all others.
TEST(FalseColour, ScaleIgnoresOneBrightPixelInAHundred) {
  Image a(20, 10), r(20, 10);
  for (auto& pixel : a.pixels) pixel = glm::vec3(0.25f);
  a.pixels[3] = glm::vec3(1000.0f);
  for (size_t i = 10; i < 25; ++i) a.pixels[i] = glm::vec3(std::numeric_limits<float>::infinity());
  a.pixels[4] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(difference_scale(a, r), 0.25);
  Image one = r;
  one.pixels[7] = glm::vec3(0.5f);
  EXPECT_EQ(difference_scale(one, r), 0.5) << "99 % equal: the largest";
  EXPECT_EQ(difference_scale(r, r), 0.0);
}

}  // namespace
}  // namespace relight
