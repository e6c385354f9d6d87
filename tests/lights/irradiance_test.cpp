// Irradiance of each light model against formulas in double precision, written down again here.
#include <cmath>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "tests/lights/light_cases.h"
#include "tests/shading/shading_fixture.h"
#include "tests/support/form_factors.h"

namespace relight {
namespace {

struct Place {
  glm::vec3 position, normal;
};

Place random_place(uint64_t i) {
  const auto u = [i](uint64_t d) { return random_float(5, 3, i, d); };
  const glm::vec3 n = glm::normalize(glm::vec3(u(3), u(4), u(5)) - 0.5f);
  return {glm::vec3(4.0f * u(0) - 2.0f, 3.0f * u(1) - 1.0f, 4.0f * u(2) - 2.0f), n};
}

glm::vec3 irradiance(const std::vector<Emitter>& emitters, const Place& p) {
  glm::vec3 sum(0.0f);
  for (const Emitter& e : emitters) sum += e.irradiance(p.position, p.normal, p.normal);
  return sum;
}

// E = E0 max(0, n . -d). Red if (tried): the direction's sign is turned.
TEST(DirectionalIrradiance, IsTheCosineLawEverywhere) {
  const Light light = test::directional_light({0.4f, -1.0f, -0.3f});
  int lit = 0;
  for (uint64_t i = 0; i < 2000; ++i) {
    const Place p = random_place(i);
    const double cosine = -glm::dot(glm::dvec3(p.normal), glm::normalize(glm::dvec3(0.4, -1.0, -0.3)));
    EXPECT_NEAR(irradiance({emitter_of(light)}, p).x, 3.0 * std::max(0.0, cosine), 1e-6) << i;
    lit += cosine > 0.0;
  }
  EXPECT_GT(lit, 500);
}

// E = L x area / n x sum of cos cos' / r^2 over the same points, in double. Red if (tried): the emitter's
// cosine is missing.
TEST(AreaIrradiance, IsTheSumOverItsPoints) {
  const Light light = test::rectangle_light({0.1f, 1.9f, -0.2f}, {0.6f, 0, 0}, {0, 0, 0.4f});
  const glm::dvec3 normal(light.direction);
  const auto emitters = emitters_of(light, 16, 0.0f);
  int lit = 0;
  for (uint64_t i = 0; i < 2000; ++i) {
    const Place p = random_place(i);
    double sum = 0.0, scale = 0.0;
    for (const Emitter& e : emitters) {
      const glm::dvec3 d = glm::dvec3(e.position()) - glm::dvec3(p.position);
      const double r2 = glm::dot(d, d), here = glm::dot(glm::dvec3(p.normal), d) / std::sqrt(r2);
      const double there = -glm::dot(normal, d) / std::sqrt(r2);
      sum += std::max(here, 0.0) * std::max(there, 0.0) / r2;
      scale += 1.0 / r2;
    }
    const double factor = 5.0 * 4.0 * 0.6 * 0.4 / 16.0;
    EXPECT_NEAR(irradiance(emitters, p).x, factor * sum, factor * scale * 1e-6) << i;
    lit += sum > 0.0;
  }
  EXPECT_GT(lit, 500);
}

// Against the exact form factor of a rectangle at points on the floor, at least 2.4 widths away: the relative
// error is below 1/(2n). Red if (tried): the points fill only half of the
// rectangle.
TEST(AreaIrradiance, ConvergesToTheFormFactor) {
  const Light light = test::rectangle_light({0.1f, 1.9f, -0.2f}, {0.6f, 0, 0}, {0, 0, 0.4f});
  const check::Rectangle exact{{-0.5, 1.9, -0.6}, {1.2, 0, 0}, {0, 0, 0.8}};
  for (const int n : {4, 16, 64, 1024}) {
    double worst = 0.0;
    for (uint64_t i = 0; i < 200; ++i) {
      Place p = random_place(i);
      p.position.y = -1.0f, p.normal = {0, 1, 0};
      const double expected =
          5.0 * 3.14159265358979 * check::form_factor(glm::dvec3(p.position), glm::dvec3(p.normal), exact);
      worst =
          std::max(worst, std::abs(double(irradiance(emitters_of(light, n, 0.0f), p).x) / expected - 1.0));
    }
    EXPECT_LT(worst, 0.5 / n) << n;
  }
}

}  // namespace
}  // namespace relight
