// The yardstick itself: analytic form factors and the radiosity solver against known numbers.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/radiosity_rooms.h"

namespace relight::check {
namespace {

// Published values for the unit cube (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
// C-11 and C-14). Red if: a term of either antiderivative is wrong (tried: 0.25 made 0.26).
TEST(FormFactors, OfTheUnitCubeAreTheTextbookValues) {
  const std::vector<Rectangle> cube = faces(glm::dvec3(0.0), glm::dvec3(1.0));
  EXPECT_NEAR(form_factor(cube[0], cube[1]), 0.199825, 1e-6);
  EXPECT_NEAR(form_factor(cube[0], cube[2]), 0.200044, 1e-6);
  for (const Rectangle& from : cube) {
    double sum = 0.0;
    for (const Rectangle& to : cube) sum += form_factor(from, to);
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

// Midpoint rule over the kernel cos cos / (pi r^2).
double quadrature(const Rectangle& from, const Rectangle& to, int n) {
  double sum = 0.0;
  for (int i = 0; i < n * n; ++i)
    for (int j = 0; j < n * n; ++j) {
      const glm::dvec3 d =
          to.at((j % n + 0.5) / n, (j / n + 0.5) / n) - from.at((i % n + 0.5) / n, (i / n + 0.5) / n);
      const double r2 = glm::dot(d, d);
      sum -= glm::dot(from.normal(), d) * glm::dot(to.normal(), d) / (M_PI * r2 * r2);
    }
  return sum * to.area() / std::pow(n, 4);
}

// Red if: offsets, orientation or the common axis are mixed up for rectangles anywhere (tried: the axis
// after the first normal's taken for the common one).
TEST(FormFactors, OfRectanglesAnywhereEqualQuadrature) {
  const Rectangle floor{{0.1, 0.0, 0.2}, {0, 0, 0.5}, {0.7, 0, 0}};
  const Rectangle ceiling{{-0.3, 0.8, 0.6}, {0.4, 0, 0}, {0, 0, 0.9}};
  const Rectangle wall{{1.3, 0.2, -0.4}, {0, 0, 0.8}, {0, 0.6, 0}};
  const Rectangle back{{0.2, 0.1, -0.5}, {0.9, 0, 0}, {0, 0.4, 0}};
  const Rectangle pairs[4][2] = {{floor, ceiling}, {floor, wall}, {floor, back}, {wall, back}};
  for (const auto& [p, q] : pairs) {
    EXPECT_NEAR(form_factor(p, q), quadrature(p, q, 24), 2e-3 * form_factor(p, q));
    EXPECT_NEAR(form_factor(p, q) * p.area(), form_factor(q, p) * q.area(), 1e-14);
    // The factor from a point is the kernel over one rectangle: its mean is the factor.
    double mean = 0.0;
    for (int i = 0; i < 1600; ++i)
      mean += form_factor(p.at((i % 40 + 0.5) / 40, (i / 40 + 0.5) / 40), p.normal(), q) / 1600;
    EXPECT_NEAR(mean, form_factor(p, q), 1e-3 * form_factor(p, q));
  }
}

// Red if: a cell sees through the block, or the block hides what it doesn't (tried: every pair visible).
TEST(RadiosityRoom, FormFactorsOfAClosedRoomSumToOne) {
  const RadiosityRoom empty(cornell_room(true, false).surfaces, {}, 1.0 / 6.0);
  for (size_t i = 0; i < empty.cells(); ++i) EXPECT_NEAR(empty.form_factor_sum(i), 1.0, 1e-10);
  const Room room = cornell_room(true, true);
  const RadiosityRoom blocked(room.surfaces, room.block, 1.0 / 6.0);
  double mean = 0.0, count = 0.0;
  for (size_t i = 0; i < blocked.cells(); ++i) {
    if (blocked.hidden(i)) continue;
    // 4 x 4 points a cell decide visibility: single cells beside the block's edges err by a few percent.
    EXPECT_NEAR(blocked.form_factor_sum(i), 1.0, 0.06) << i;
    mean += blocked.form_factor_sum(i), count += 1.0;
  }
  EXPECT_NEAR(mean / count, 1.0, 0.005);
}

// In a closed room of one albedo where everything shines alike, radiosity is emission / (1 - albedo).
TEST(RadiosityRoom, SolvesTheFurnaceExactly) {
  Room room = cornell_room(true, false);
  for (Surface& s : room.surfaces) s.albedo = glm::dvec3(0.9), s.emission = {1.0, 2.0, 0.0};
  const RadiosityRoom solver(room.surfaces, {}, 1.0 / 6.0);
  for (const glm::dvec3& b : solver.solve(solver.emitted())) {
    EXPECT_NEAR(b.x, M_PI * 10.0, 1e-8);
    EXPECT_NEAR(b.y, M_PI * 20.0, 1e-8);
  }
}

}  // namespace
}  // namespace relight::check
