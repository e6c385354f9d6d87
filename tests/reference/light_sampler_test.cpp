#include <cmath>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "reference/light_sampler.h"
#include "tests/support/tiny_scenes.h"

namespace relight::tiny {
namespace {

constexpr float almost_one = 1.0f - 0x1p-24f;

// Red if (tried: 1 % too wide): a direction leaves the cone, or the unit sphere at the ends of [0,1).
TEST(LightSampler, EmitsInsideTheConeForEveryAngle) {
  for (float outer : {0.2f, 5.0f, 45.0f, 89.0f}) {
    const LightSampler sampler(lighting({spot({1, 2, 3}, {0.3f, -1.0f, 0.2f}, 0.5f * outer, outer)}));
    const glm::vec3 axis(sampler.emitter(0).params.direction_outer);
    double mean = 0;
    const int n = 4096;
    for (uint32_t i = 0; i < n; ++i) {
      const LightRay ray = sampler.emit(0.3f, sobol_2d(i, 1));
      ASSERT_NEAR(glm::length(ray.direction), 1.0f, 1e-6f);
      const double angle =
          std::asin(std::min(1.0, static_cast<double>(glm::length(glm::cross(axis, ray.direction)))));
      ASSERT_LT(angle, glm::radians(static_cast<double>(outer)) * 1.001);
      mean += (1.0 - std::cos(angle)) / n;
    }
    // Uniform over the cone: 1 - cos is uniform.
    EXPECT_NEAR(mean / (0.5 * (1.0 - std::cos(glm::radians(static_cast<double>(outer))))), 1.0, 0.01)
        << outer;
    for (float u : {0.0f, almost_one})
      for (float v : {0.0f, almost_one})
        EXPECT_NEAR(glm::length(sampler.emit(v, {u, v}).direction), 1.0f, 1e-6f);
  }
}

// Red if (tried): the density of a spot is that of the whole sphere.
TEST(LightSampler, DensitiesIntegrateToTheProbabilityOfTheLight) {
  const LightSampler sampler(
      lighting({omni({0, 0, 0}), spot({0, 0, 0}, {0, 0, 1}, 20, 30, glm::vec3(5.0f))}));
  const double cone = 2.0 * M_PI * (1.0 - std::cos(glm::radians(30.0)));
  EXPECT_NEAR(static_cast<double>(sampler.emission_pdf(0)) * 4.0 * M_PI +
                  static_cast<double>(sampler.emission_pdf(1)) * cone,
              1.0, 1e-5);
}

// Red if (tried): the probability isn't that of choose(), which goes by power.
TEST(LightSampler, ChoosesAmongManyLightsByPower) {
  const LightingState few = lighting({omni({0, 0, 0}), omni({0, 0, 1})});
  EXPECT_TRUE(LightSampler(few).all());
  EXPECT_EQ(LightSampler(few).next_event_probability(1), 1.0f);
  LightingState many = few;
  for (int i = 0; i < 3; ++i) many.lights.push_back(spot({0, 0, 0}, {0, 0, 1}, 20, 30, glm::vec3(5.0f)));
  const LightSampler sampler(many);
  ASSERT_FALSE(sampler.all());
  const double cone = 2.0 * M_PI * (1.0 - std::cos(glm::radians(30.0)));
  EXPECT_NEAR(sampler.next_event_probability(3) / sampler.next_event_probability(0),
              5.0 * cone / (4.0 * M_PI), 1e-4);
  int count[5] = {};
  for (int i = 0; i < 10000; ++i) ++count[sampler.choose((static_cast<float>(i) + 0.5f) / 10000.0f)];
  for (size_t light = 0; light < 5; ++light)
    EXPECT_NEAR(count[light], 1e4f * sampler.next_event_probability(light), 2);
}

// Red if (both tried): a light of no power is chosen, or a choice at u = 0 ends on a light that must not
// emit.
TEST(LightSampler, LeavesOutDarkLightsAndEmitsOnlyFromLightsWithShadows) {
  LightingState state =
      lighting({omni({0, 0, 0}), omni({1, 0, 0}, glm::vec3(0.0f)), omni({2, 0, 0}), omni({3, 0, 0})});
  state.lights[0].casts_shadows = state.lights[3].casts_shadows = false;
  const LightSampler sampler(state);
  ASSERT_EQ(sampler.size(), 3u);
  for (float u : {0.0f, 0.3f, 0.9f, almost_one}) EXPECT_EQ(sampler.emit(u, {0.5f, 0.5f}).origin.x, 2.0f) << u;
  EXPECT_EQ(sampler.choose(0.0f), 0u);
  EXPECT_EQ(sampler.choose(0.5f), 1u);
  EXPECT_EQ(sampler.choose(almost_one), 2u);
  EXPECT_EQ(sampler.emission_pdf(0), 0.0f);
  EXPECT_EQ(LightSampler(LightingState{}).emit(0.5f, {0.5f, 0.5f}).directional_pdf, 0.0f);
}

}  // namespace
}  // namespace relight::tiny
