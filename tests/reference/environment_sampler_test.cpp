// Importance sampling of environment maps: the density is that of the samples, and no light is out of its
// reach.
#include "reference/environment_sampler.h"

#include <gtest/gtest.h>

#include "tests/reference/skies.h"

namespace relight::tiny {
namespace {

glm::vec2 draw(std::mt19937_64& random) {
  std::uniform_real_distribution<float> u(0.0f, 1.0f);
  glm::vec2 point{u(random), u(random)};
  return glm::min(point, glm::vec2(1.0f - 0x1p-24f));  // libstdc++ may round up to 1
}

// Upper 1e-6 quantile of chi-square (Wilson and Hilferty, 1931).
double chi_square_limit(double freedom) {
  const double a = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - a + 4.753 * std::sqrt(a), 3.0);
}

// Solid angle of a cell of a grid of `rows` x `columns` cells, uniform in azimuth and polar angle.
double cell_solid_angle(int row, int rows, int columns) {
  return (std::cos(M_PI * row / rows) - std::cos(M_PI * (row + 1) / rows)) * 2.0 * M_PI / columns;
}

// Each texel is cut into 3 x 3 cells; cells that expect fewer than 8 samples are counted together. A false
// alarm has probability 1e-6 for each map. Red if (tried): samples lie uniform in the polar angle instead of
// its cosine, the azimuth is drawn without its place inside the texel, or the columns of the next row are
// used.
TEST(EnvironmentSampler, DrawsDirectionsWithTheDensityThatItStates) {
  for (const float rotation : {0.0f, 2.3f, -4.0f}) {
    const Environment map = uneven_map(12, 7, rotation);
    const EnvironmentSampler sampler(map);
    const int fine = 3, columns = fine * map.width, rows = fine * map.height, n = 200000;
    std::vector<double> found(static_cast<size_t>(columns * rows), 0.0);
    std::mt19937_64 random(1);
    for (int i = 0; i < n; ++i) {
      const glm::dvec3 d(sampler.sample(draw(random)).direction);
      const glm::dvec2 place = static_cast<double>(fine) * place_in_map(map, d);
      found[static_cast<size_t>(std::min(static_cast<int>(place.y), rows - 1) * columns +
                                std::min(static_cast<int>(place.x), columns - 1))] += 1.0;
    }
    double statistic = 0.0, freedom = -1.0, rare_expected = 0.0, rare_found = 0.0;
    for (int c = 0; c < columns * rows; ++c) {
      const glm::dvec3 centre =
          direction_at(map, glm::dvec2(c % columns + 0.5, c / columns + 0.5) / static_cast<double>(fine));
      const double expected = n * static_cast<double>(sampler.pdf(glm::vec3(centre))) *
                              cell_solid_angle(c / columns, rows, columns);
      const double count = found[static_cast<size_t>(c)];
      if (expected < 8.0) {
        rare_expected += expected, rare_found += count;
        continue;
      }
      statistic += (count - expected) * (count - expected) / expected;
      freedom += 1.0;
    }
    if (rare_expected > 0.0)
      statistic += std::pow(rare_found - rare_expected, 2) / rare_expected, freedom += 1.0;
    EXPECT_LT(statistic, chi_square_limit(freedom)) << freedom << " degrees of freedom";
    EXPECT_GT(freedom, 300.0) << "the test has lost its cells";
  }
}

// Red if (tried): texel_pdf() takes the solid angle of a row from its middle, or the rows' sum is off by 1 %.
TEST(EnvironmentSampler, HasADensityThatIntegratesToOne) {
  for (const glm::ivec2 size : {glm::ivec2(12, 7), glm::ivec2(1, 1), glm::ivec2(2, 3), glm::ivec2(64, 32)}) {
    const Environment map = uneven_map(size.x, size.y, 0.7f);
    const EnvironmentSampler sampler(map);
    const glm::dvec3 sum = integrate_map(map, {0, 0}, size - 1, 1, [&](const glm::dvec3& d) {
      return glm::dvec3(static_cast<double>(sampler.pdf(glm::vec3(d))));
    });
    EXPECT_NEAR(sum.x, 1.0, 1e-5) << size.x << " x " << size.y;
  }
}

// One sample in 10^4 may lie so near a border that rounding moves it to the next texel. Red if (tried): pdf()
// turns the map the other way, or mirrors it.
TEST(EnvironmentSampler, StatesTheSameDensityForASampleAndForItsDirection) {
  for (const float rotation : {0.0f, 1.9f, -11.0f}) {
    const Environment map = uneven_map(64, 32, rotation);
    const EnvironmentSampler sampler(map);
    std::mt19937_64 random(2);
    int different = 0;
    for (int i = 0; i < 20000; ++i) {
      const EnvironmentSample sample = sampler.sample(draw(random));
      ASSERT_GT(sample.pdf, 0.0f);
      ASSERT_NEAR(glm::length(sample.direction), 1.0f, 1e-6f);
      different += std::abs(sampler.pdf(sample.direction) / sample.pdf - 1.0f) > 1e-4f;
    }
    EXPECT_LE(different, 2);
  }
}

// Red if (tried): find() takes the first interval that reaches u (lower_bound): at u = 0 that has no width.
TEST(EnvironmentSampler, StaysInTheMapAtTheEndsOfTheUnitSquare) {
  constexpr float almost_one = 1.0f - 0x1p-24f;
  for (const int column : {0, 3, 7})
    for (const int row : {0, 2, 3}) {
      const Environment map = one_texel(8, 4, column, row, 0.4f);
      const EnvironmentSampler sampler(map);
      for (const float x : {0.0f, 0.5f, almost_one})
        for (const float y : {0.0f, 0.5f, almost_one}) {
          const EnvironmentSample sample = sampler.sample({x, y});
          EXPECT_TRUE(std::isfinite(sample.pdf) && sample.pdf > 0.0f) << x << " " << y;
          EXPECT_NEAR(glm::length(sample.direction), 1.0f, 1e-6f);
        }
    }
}

// Red if (tried): a black map divides by its sum of zero.
TEST(EnvironmentSampler, HasNothingToSampleInConstantAndBlackSurroundings) {
  Environment constant, black = black_map(8, 4), dark = uneven_map(8, 4, 0.0f);
  constant.radiance = glm::vec3(2.0f);
  dark.radiance = glm::vec3(0.0f);
  for (const Environment& map : {constant, black, dark, Environment{}}) {
    const EnvironmentSampler sampler(map);
    EXPECT_TRUE(sampler.empty());
    EXPECT_EQ(sampler.sample({0.3f, 0.6f}).pdf, 0.0f);
    EXPECT_EQ(sampler.pdf({0.0f, 1.0f, 0.0f}), 0.0f);
  }
}

}  // namespace
}  // namespace relight::tiny
