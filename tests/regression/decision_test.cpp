// The decision on synthetic pictures of known noise: each question alone must notice what it is for.
#include "experiments/stored_references/decision.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/run/error.h"

namespace relight::test {
namespace {

constexpr int width = 48, height = 36, batches = 32;

// `batches` pictures of brightness 1 and noise of 10 % a pixel, of which half the variance is common to a
// tile.
PictureStatistics noisy_picture(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Image> images(batches, Image(width, height)), tiles, wholes;
  for (Image& image : images) {
    Image common(width / tile_side, height / tile_side);
    for (glm::vec3& p : common.pixels) p = glm::vec3(static_cast<float>(normal(random)));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.at(x, y) = glm::vec3(1.0f) + 0.0707f * (common.at(x / tile_side, y / tile_side) +
                                                      glm::vec3(static_cast<float>(normal(random))));
    tiles.push_back(block_means(image, tile_side));
    wholes.push_back(block_means(image, width));
  }
  const auto estimate = [](const std::vector<Image>& values) {
    Estimate e{Image(values[0].width, values[0].height), Image(values[0].width, values[0].height)};
    for (size_t i = 0; i < e.mean.pixels.size(); ++i) {
      glm::vec3 mean(0.0f), squares(0.0f);
      for (const Image& v : values) mean += v.pixels[i] / static_cast<float>(batches);
      for (const Image& v : values) squares += (v.pixels[i] - mean) * (v.pixels[i] - mean);
      e.mean.pixels[i] = mean;
      e.variance.pixels[i] = squares / static_cast<float>(batches * (batches - 1));
    }
    return e;
  };
  PictureStatistics picture;
  picture.direct = Image(width, height, glm::vec3(0.5f));
  picture.pixels = estimate(images), picture.tiles = estimate(tiles), picture.whole = estimate(wholes);
  picture.batches = picture.samples_per_pixel = batches;
  return picture;
}

bool differs(const Decision& decision, const std::string& name) {
  for (const Question& q : decision.questions)
    if (q.name == name) return q.p_value < decision.level;
  ADD_FAILURE() << "no question " << name;
  return false;
}

// Red if: the tests are too strict. At a level of 5 %, all questions together, 400 pairs would alarm 20
// +- 4.4 times; fewer do, because the larger of two estimates of the noise is used and Sidak is an upper
// bound.
TEST(Decision, FalseAlarmsAreNotMoreFrequentThanStated) {
  int alarms = 0;
  for (unsigned i = 0; i < 400; ++i)
    alarms += !compare_pictures(noisy_picture(2 * i), noisy_picture(2 * i + 1), 0.05).same();
  EXPECT_LE(alarms, 33);
  EXPECT_GE(alarms, 1) << "so strict a level that nothing is tested";
}

TEST(Decision, OnePixelWrongIsNoticed) {
  PictureStatistics fresh = noisy_picture(1);
  fresh.pixels.mean.at(17, 11).y += 0.3f;  // 17 standard errors of one picture, 12 of the difference
  const Decision decision = compare_pictures(fresh, noisy_picture(2));
  EXPECT_TRUE(differs(decision, "pixels")) << decision.to_string();
  EXPECT_NE(decision.to_string().find("(17, 11)"), std::string::npos) << decision.to_string();
}

// Red if: errors that cancel in the mean and are small in each pixel are missed.
TEST(Decision, ManyTilesSlightlyWrongAreNoticed) {
  PictureStatistics fresh = noisy_picture(1);
  for (size_t i = 0; i < fresh.tiles.mean.pixels.size(); ++i)
    fresh.tiles.mean.pixels[i] += glm::vec3(i % 2 == 0 ? 0.04f : -0.04f);
  const Decision decision = compare_pictures(fresh, noisy_picture(2));
  EXPECT_TRUE(differs(decision, "tiles beyond 2")) << decision.to_string();
  EXPECT_FALSE(differs(decision, "picture")) << decision.to_string();
}

TEST(Decision, AMeanOffByTwoPercentIsNoticed) {
  PictureStatistics fresh = noisy_picture(1);
  fresh.whole.mean.pixels[0] *= 1.02f;
  EXPECT_TRUE(differs(compare_pictures(fresh, noisy_picture(2)), "picture"));
}

// Red if: a change of direct light hides behind the tolerance for shadow edges.
TEST(Decision, DirectLightMayDifferAtAFewPixelsOnly) {
  const PictureStatistics stored = noisy_picture(2);
  PictureStatistics fresh = noisy_picture(1);
  fresh.direct.at(3, 3) *= 1.1f;
  EXPECT_TRUE(compare_pictures(fresh, stored).same());
  fresh.direct.at(3, 3) *= 100.0f;
  EXPECT_TRUE(differs(compare_pictures(fresh, stored), "direct")) << "its mean";
  fresh = noisy_picture(1);
  for (glm::vec3& p : fresh.direct.pixels) p *= 1.0015f;
  EXPECT_TRUE(differs(compare_pictures(fresh, stored), "direct")) << "all pixels, slightly";
}

// Red if: a picture of few samples that missed rare bright paths everywhere, dark and without noise, is taken
// at its word. A quarter of the samples, half of a standard error too dark.
TEST(Decision, APictureIsNotTakenToBeSurerThanItsSamplesAllow) {
  const PictureStatistics stored = noisy_picture(2);
  PictureStatistics fresh = stored;
  fresh.samples_per_pixel /= 4;
  for (Estimate* e : {&fresh.pixels, &fresh.tiles, &fresh.whole})
    for (size_t i = 0; i < e->mean.pixels.size(); ++i) {
      e->mean.pixels[i] -= glm::sqrt(e->variance.pixels[i]);
      e->variance.pixels[i] = glm::vec3(0.0f);
    }
  const Decision decision = compare_pictures(fresh, stored);
  EXPECT_TRUE(decision.same()) << decision.to_string();
}

TEST(Decision, SamplesThatAreNotFiniteMakePicturesDiffer) {
  PictureStatistics fresh = noisy_picture(1);
  fresh.non_finite = 1;
  EXPECT_FALSE(compare_pictures(fresh, noisy_picture(2)).same());
  fresh = noisy_picture(1);
  fresh.pixels.mean.at(0, 0).x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(compare_pictures(fresh, noisy_picture(2)).same());
  fresh = noisy_picture(1);
  fresh.direct.at(0, 0).x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(compare_pictures(fresh, noisy_picture(2)).same());
}

TEST(Decision, PicturesOfDifferentSizesAreRefused) {
  PictureStatistics fresh = noisy_picture(1);
  fresh.direct = Image(8, 8);
  EXPECT_THROW(compare_pictures(fresh, noisy_picture(2)), Error);
}

}  // namespace
}  // namespace relight::test
