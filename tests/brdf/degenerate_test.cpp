// The ends of the unit interval, grazing and coinciding directions: finite, not negative, unit length.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "tests/brdf/brdf_cases.h"

namespace relight {
namespace {

constexpr float almost_one = 1.0f - 0x1p-24f;
const float ends[] = {0.0f, 0x1p-149f, 0x1p-24f, 0.25f, 0.5f, almost_one};

bool bounded(float x) { return std::isfinite(x) && x >= 0.0f; }
bool bounded(const glm::vec3& v) { return bounded(v.x) && bounded(v.y) && bounded(v.z); }

// Directions in the frame of the normal, from along it to beyond the horizon.
std::vector<glm::vec3> hard_directions() {
  std::vector<glm::vec3> list = {{0, 0, 1},      {1, 0, 0},       {0, -1, 0},
                                 {1, 0, 1e-20f}, {-1, 0, 1e-20f}, {0, 0, -1}};
  for (double z : {1.0 - 1e-7, 0.7, 1e-3, 1e-4, 1e-7, -1e-4, -0.5})
    for (double azimuth : {0.0, 1.0, 1.0 + std::numbers::pi}) list.push_back(test::direction(z, azimuth));
  return list;
}

const glm::vec3 normals[] = {
    {0, 0, 1}, {0, 0, -1}, {-1, -0.0f, -0.0f}, glm::normalize(glm::vec3(0.3f, -0.2f, 0.9f))};

// Red if a sample at an end of [0,1) needs sqrt of a negative number, a zero half vector, tan(pi/2) or log(0)
// (tried: the A-S value and density without their smallest denominators).
TEST(Degenerate, SamplesAtTheEndsOfTheUnitIntervalAreFiniteUnitVectors) {
  for (const test::BrdfCase& c : test::brdf_cases())
    for (const glm::vec3& n : normals)
      for (const glm::vec3& local : hard_directions())
        for (float u_lobe : {0.0f, 0.5f, almost_one})
          for (float x : ends)
            for (float y : ends) {
              const glm::vec3 wo = frame_around(n) * local;
              const BrdfSample s = sample_brdf(c.brdf, n, wo, u_lobe, {x, y}, false);
              ASSERT_TRUE(bounded(s.pdf)) << c.name << ' ' << wo.z << ' ' << u_lobe << ' ' << x << ' ' << y;
              if (!(s.pdf > 0.0f)) continue;
              ASSERT_NEAR(glm::length(s.wi), 1.0f, 1e-5f) << c.name << ' ' << wo.z << ' ' << x << ' ' << y;
              const glm::vec3 f = shader::brdf_eval(c.brdf, n, wo, s.wi);
              ASSERT_TRUE(bounded(f)) << c.name << ' ' << wo.z << ' ' << x << ' ' << y;
              ASSERT_TRUE(bounded(f * (std::max(0.0f, glm::dot(n, s.wi)) / s.pdf))) << c.name;
            }
}

// Red if wi = wo, wi = -wo, both grazing or one below the horizon divides 0 by 0 or overflows (tried: the
// same).
TEST(Degenerate, ValuesAndDensitiesAreFiniteForEveryPairOfHardDirections) {
  for (const test::BrdfCase& c : test::brdf_cases())
    for (const glm::vec3& n : normals)
      for (const glm::vec3& a : hard_directions())
        for (const glm::vec3& b : hard_directions())
          for (float sign : {1.0f, -1.0f}) {
            const glm::mat3 frame = frame_around(n);
            const glm::vec3 wo = frame * a, wi = sign * (frame * b);
            ASSERT_TRUE(bounded(shader::brdf_eval(c.brdf, n, wo, wi))) << c.name << ' ' << a.z << ' ' << b.z;
            ASSERT_TRUE(bounded(brdf_pdf(c.brdf, n, wo, wi, false))) << c.name << ' ' << a.z << ' ' << b.z;
          }
}

// A black glossy part must switch every model off: light path classes are made that way
// (reference/path_vertex.h). Red if Fresnel still rises from black in the value (tried).
TEST(Degenerate, ABlackGlossyPartLeavesLambertAlone) {
  const glm::vec3 n(0, 0, 1);
  for (test::BrdfCase c : test::brdf_cases()) {
    c.brdf.glossy = glm::vec3(0.0f);
    for (const glm::vec3& wo : test::eye_directions()) {
      const glm::vec3 wi = test::direction(0.4, 5.0);
      EXPECT_EQ(shader::brdf_eval(c.brdf, n, wo, wi), shader::brdf_diffuse(c.brdf)) << c.name;
      EXPECT_EQ(brdf_pdf(c.brdf, n, wo, wi, false), brdf_pdf(c.brdf, n, wo, wi, true)) << c.name;
    }
  }
}

}  // namespace
}  // namespace relight
