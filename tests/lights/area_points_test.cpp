// The points that stand for a light with an area.
#include "common/lights/area_points.h"

#include <set>

#include <gtest/gtest.h>

#include "common/lights/emitter.h"
#include "tests/lights/light_cases.h"

namespace relight {
namespace {

// Red if (tried): the radical inverse is not shifted to the middle of its stratum, or its digits are turned.
TEST(StratifiedPoints, HaveOnePointInEveryElementaryInterval) {
  for (const uint32_t n : {1u, 4u, 16u, 64u}) {
    for (uint32_t columns = 1; columns <= n; columns *= 2) {
      std::set<std::pair<int, int>> cells;
      for (uint32_t i = 0; i < n; ++i) {
        const glm::vec2 p = stratified_point(i, n);
        EXPECT_TRUE(p.x > 0.0f && p.x < 1.0f && p.y > 0.0f && p.y < 1.0f);
        cells.insert({int(p.x * float(columns)), int(p.y * float(n / columns))});
      }
      EXPECT_EQ(cells.size(), n) << columns << " columns of " << n;
    }
  }
  EXPECT_EQ(stratified_point(0, 1), glm::vec2(0.5f));
}

// Red if (tried): points of a disc crowd at its centre, or fill half of its radius.
TEST(AreaShape, SpreadsPointsEvenly) {
  const AreaShape disc(test::disc_light({1, 2, 3}, {0, -1, 0}, 0.5f), 0.0f);
  constexpr uint32_t n = 4096;
  int inner = 0;
  glm::dvec3 sum(0.0);
  for (uint32_t i = 0; i < n; ++i) {
    const glm::vec3 p = disc.point(stratified_point(i, n));
    const float r = glm::length(p - disc.centre);
    EXPECT_LE(r, 0.5f * (1.0f + 1e-5f));
    inner += r < 0.25f;
    sum += glm::dvec3(p - disc.centre);
  }
  EXPECT_NEAR(inner, n / 4, 0.01 * n);
  EXPECT_LT(glm::length(sum) / n, 1e-3);
  EXPECT_NEAR(disc.area, 3.14159265f * 0.25f, 1e-6f);
}

// Intensities add up to radiance x area, whatever the number. Red if (tried): not divided by the number of
// points; the area of a rectangle by its half edges.
TEST(Emitters, OfAnAreaShareItsIntensity) {
  const Light light = test::rectangle_light({0, 1, 0}, {0.5f, 0, 0}, {0, 0, 0.25f}, glm::vec3(8.0f));
  for (const int n : {1, 7, 16}) {
    const std::vector<Emitter> points = emitters_of(light, n, 0.125f);
    ASSERT_EQ(points.size(), static_cast<size_t>(n));
    float sum = 0.0f;
    for (const Emitter& e : points) {
      sum += shader::light_intensity(e.params, light.direction).x;
      EXPECT_NEAR(shader::light_intensity(e.params, glm::normalize(light.direction + glm::vec3(1, 0, 0))).x,
                  8.0f * 0.5f / float(n) * std::sqrt(0.5f), 1e-5f);
      EXPECT_EQ(shader::light_intensity(e.params, -light.direction).x, 0.0f);
      EXPECT_FLOAT_EQ(glm::dot(e.position() - light.position, light.direction), 0.125f) << "lifted";
    }
    EXPECT_NEAR(sum, 8.0f * 0.5f, 1e-5f);
  }
}

}  // namespace
}  // namespace relight
