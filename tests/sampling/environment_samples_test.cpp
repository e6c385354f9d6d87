// The equal-area octahedral square and mean radiances over its texels. Not tried yet, each should be red: the
// lower hemisphere's mirrored coordinates not exchanged; azimuth counted from +z; the share of odd quadrants
// not reversed; Morton bits of rows and columns exchanged in direction() alone; half a texel of the map's
// columns; its rotation with the other sign; the map's taps without their weights; one centre lookup a texel
// instead of the sum over the map.
#include <cmath>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/environment_samples.h"
#include "common/sampling/random.h"
#include "tests/reference/skies.h"

namespace relight {
namespace {

glm::dvec2 random_place(uint64_t number) {
  return {static_cast<double>(random_float(1, 7, number, 0)),
          static_cast<double>(random_float(1, 7, number, 1))};
}

// The same place in the neighbourhood of a texel's corner, too.
TEST(EnvironmentSquare, EveryDirectionOfATexelIsUnitAndFallsIntoItAndIntoItsParents) {
  const EnvironmentSquare square(4096), parent(1024), root(4);
  for (uint32_t t = 0; t < square.texels(); ++t)
    for (uint64_t k = 0; k < 4; ++k) {
      const glm::dvec2 place = glm::dvec2(1e-4) + (1.0 - 2e-4) * random_place(4 * t + k);
      const glm::dvec3 d = square.direction(t, place);
      ASSERT_NEAR(glm::length(d), 1.0, 1e-12);
      ASSERT_EQ(square.texel_of(glm::vec3(d)), t);
      ASSERT_EQ(parent.texel_of(glm::vec3(d)), t / 4);
      ASSERT_EQ(root.texel_of(glm::vec3(d)), t / 1024);
    }
}

// |d direction / du x d direction / dv| x texels = 4 pi everywhere but at the creases, where a difference
// would reach across. Central differences of 1e-5 of a texel: 1e-6.
TEST(EnvironmentSquare, EqualAreasAreEqualSolidAngles) {
  const EnvironmentSquare square(256);
  constexpr double h = 1e-5;
  for (uint32_t t = 0; t < square.texels(); ++t) {
    const glm::dvec2 p = 0.1 + 0.8 * random_place(t);
    const auto at = [&](double x, double y) { return square.direction(t, p + glm::dvec2(x, y)); };
    const glm::dvec3 du = (at(h, 0) - at(-h, 0)) / (2.0 * h), dv = (at(0, h) - at(0, -h)) / (2.0 * h);
    const bool on_a_crease = std::abs(p.x - p.y) < 1e-3 || std::abs(p.x + p.y - 1.0) < 1e-3;
    if (on_a_crease) continue;
    EXPECT_NEAR(glm::length(glm::cross(du, dv)), square.solid_angle(), 1e-5 * square.solid_angle()) << t;
  }
}

TEST(EnvironmentSquare, TheUpperHemisphereIsTheDiamondInTheMiddle) {
  const EnvironmentSquare square(4096);
  int above = 0;
  for (uint32_t t = 0; t < square.texels(); ++t) {
    bool up = true;
    for (const double x : {0.1, 0.9})
      for (const double y : {0.1, 0.9}) up = up && square.direction(t, {x, y}).y > 0.0;
    above += up;
  }
  // Half of the texels, less the 126 that the diamond's sides cross.
  EXPECT_NEAR(above, 2048 - 64, 1);
  EXPECT_EQ(square.texel_of(glm::vec3(0, 1, 0)), 3u * 1024u) << "the middle's lower right texel";
}

TEST(EnvironmentSquare, RefusesNumbersThatAreNoPowersOfFour) {
  for (const int64_t bad : {0, 1, 2, 5000, 8192, 1 << 22}) EXPECT_THROW(EnvironmentSquare{bad}, Error) << bad;
}

glm::dvec3 integral(const std::vector<glm::dvec3>& means, const EnvironmentSquare& square) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& m : means) sum += m * square.solid_angle();
  return sum;
}

// The integral by the same lookup, on a grid of its own. Both are midpoint sums of a function with kinks at
// texel centres; the finer has 24 x 24 points a texel.
TEST(MeanRadiance, SumsToTheMapsIntegral) {
  for (const float rotation : {0.0f, 0.7f}) {
    Environment map = tiny::uneven_map(64, 32, rotation);
    map.radiance = {1.0f, 2.0f, 0.5f};
    const glm::dvec3 expected = tiny::integrate_map(
        map, {0, 0}, {63, 31}, 24, [&](const glm::dvec3& d) { return glm::dvec3(map.lookup(glm::vec3(d))); });
    for (const int64_t n : {256, 4096}) {
      const EnvironmentSquare square(n);
      const glm::dvec3 found = integral(mean_radiance(map, square), square);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-4 * expected[c]) << n;
    }
  }
}

// A sun of one texel: neither lost nor doubled, wherever it stands, and all of it within the texels of the
// square that its bilinear footprint of 2 x 2 texels reaches. Its integral: radiance x 2 pi / w x (that of
// the tent over the rows), which is that of the row's solid angle but for the curvature of the sine over two
// rows.
TEST(MeanRadiance, ASunOfOneTexelIsNeitherLostNorDoubled) {
  const EnvironmentSquare square(4096);
  for (const auto& [column, row] : {std::pair{0, 255}, {511, 256}, {1023, 100}, {300, 4}, {700, 507}}) {
    const Environment map = tiny::one_texel(1024, 512, column, row, 0.3f, glm::vec3(1e5f));
    const double band = std::cos(M_PI * row / 512) - std::cos(M_PI * (row + 1) / 512);
    const double expected = 1e5 * band * 2.0 * M_PI / 1024;
    const std::vector<glm::dvec3> means = mean_radiance(map, square);
    EXPECT_NEAR(integral(means, square).x, expected, 2e-4 * expected) << column << ", " << row;
    const glm::dvec3 sun = tiny::direction_at(map, {column + 0.5, row + 0.5});
    for (uint32_t t = 0; t < square.texels(); ++t) {
      if (!(means[t].x > 0.0)) continue;
      EXPECT_GT(glm::dot(square.direction(t, glm::dvec2(0.5)), sun), std::cos(0.08)) << t;
    }
  }
}

// The mean over a texel is that of the lookups in it: within 1 % for a smooth map, of which the points that
// cross the rim are the most; a constant environment without a map is exact.
TEST(MeanRadiance, IsTheMeanOfTheLookups) {
  for (const float rotation : {0.0f, -2.1f}) {
    Environment map = tiny::black_map(128, 64, rotation);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 128; ++x) {
        const glm::dvec3 d = tiny::direction_at(map, {x + 0.5, y + 0.5});
        map.texels[static_cast<size_t>(128 * y + x)] = glm::vec3(1.5 + d);
      }
    const EnvironmentSquare square(1024);
    const std::vector<glm::dvec3> means = mean_radiance(map, square);
    double squares = 0.0;
    for (uint32_t t = 0; t < square.texels(); ++t) {
      glm::dvec3 sum(0.0);
      for (int k = 0; k < 256; ++k)
        sum += glm::dvec3(
            map.lookup(glm::vec3(square.direction(t, {(k % 16 + 0.5) / 16, (k / 16 + 0.5) / 16}))));
      for (int c = 0; c < 3; ++c) {
        const double error = means[t][c] / (sum[c] / 256.0) - 1.0;
        ASSERT_LT(std::abs(error), 0.04) << t;
        squares += error * error / (3.0 * square.texels());
      }
    }
    EXPECT_LT(std::sqrt(squares), 0.01);
  }
  Environment constant;
  constant.radiance = {3.0f, 0.1f, 1e-4f};
  for (const glm::dvec3& m : mean_radiance(constant, EnvironmentSquare(256)))
    EXPECT_EQ(m, glm::dvec3(constant.radiance));
}

// Turning the map by a quarter turns the samples: the same numbers at other places.
TEST(MeanRadiance, TurnsWithTheEnvironment) {
  Environment map = tiny::uneven_map(64, 32, 0.0f);
  const EnvironmentSquare square(1024);
  const std::vector<glm::dvec3> before = mean_radiance(map, square);
  map.rotation_y = static_cast<float>(0.5 * M_PI);
  const std::vector<glm::dvec3> after = mean_radiance(map, square);
  for (uint32_t t = 0; t < square.texels(); ++t) {
    const glm::dvec3 d = square.direction(t, glm::dvec2(0.5));
    // Content at azimuth phi = atan2(x, -z) goes to phi - rotation: (x, z) -> (z, -x).
    const uint32_t turned = square.texel_of(glm::vec3(d.z, d.y, -d.x));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[turned][c], before[t][c], 1e-6 * before[t][c] + 1e-9) << t;
  }
}

TEST(RadiancePyramid, HoldsTheMeanOfEachNode) {
  std::vector<glm::dvec3> texels;
  for (int i = 0; i < 64; ++i) texels.emplace_back(i, 1.0, i * i);
  const std::vector<glm::dvec3> pyramid = radiance_pyramid(texels);
  ASSERT_EQ(pyramid.size(), pyramid_begin(4));
  EXPECT_EQ(pyramid[0], glm::dvec3(31.5, 1.0, 63.0 * 127.0 / 6.0));
  EXPECT_EQ(pyramid[pyramid_begin(1) + 2].x, 39.5);
  EXPECT_EQ(pyramid[pyramid_begin(2) + 5].x, 21.5);
  EXPECT_EQ(pyramid[pyramid_begin(3) + 17].z, 289.0);
}

}  // namespace
}  // namespace relight
