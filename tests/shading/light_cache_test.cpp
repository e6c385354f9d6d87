// Which lights are shaded again when one of many moves.
#include "common/shading/light_cache.h"

#include <gtest/gtest.h>

#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

LightingState lamps(const std::vector<float>& heights) {
  LightingState state;
  for (const float h : heights) state.lights.push_back(tiny::omni({0, h, 0}));
  return state;
}

// Shades with numbers in place of pictures: a light's "radiance" is its height.
class Numbers {
 public:
  float relight(const LightingState& lighting) {
    const LightCache::Plan plan = cache.plan(lighting);
    if (plan.uses_sum()) sum_ = (plan.from_zero ? 0.0f : sum_) + heights(plan.into_sum);
    cache.done();
    shaded = plan.shaded(), cached = plan.cached;
    return (plan.uses_sum() ? sum_ : 0.0f) + heights(plan.on_top);
  }
  LightCache cache;
  int64_t shaded = 0, cached = 0;

 private:
  static float heights(const std::vector<Light>& lights) {
    float sum = 0.0f;
    for (const Light& light : lights) sum += light.position.y;
    return sum;
  }
  float sum_ = 1e6f;  // whatever was left there must not show
};

// Red if a light is counted twice, forgotten, or kept after it moved (tried: the sum kept while one of its
// lights is gone; a new sum not started from zero).
TEST(LightCache, GivesTheSumOfTheLightsWhateverCameBefore) {
  Numbers numbers;
  for (const auto& heights : std::vector<std::vector<float>>{{1, 2, 4},
                                                             {1, 2, 8},
                                                             {1, 2, 16},
                                                             {1, 2, 16},
                                                             {1, 32, 16},
                                                             {1, 64, 16},
                                                             {},
                                                             {1, 64, 16},
                                                             {1, 64},
                                                             {1, 1, 64},
                                                             {1, 1, 64},
                                                             {1, 64},
                                                             {1, 64, 1, 1},
                                                             {2},
                                                             {2},
                                                             {2},
                                                             {4}}) {
    float expected = 0.0f;
    for (const float h : heights) expected += h;
    EXPECT_EQ(numbers.relight(lamps(heights)), expected);
  }
}

// Red if lights that stand still are shaded again while one moves.
TEST(LightCache, AMovingLightCostsOneShadingAFrameOnceTheOthersAreGathered) {
  Numbers numbers;
  numbers.relight(lamps({1, 2, 4, 8}));
  EXPECT_EQ(numbers.shaded, 4);
  numbers.relight(lamps({1, 2, 5, 8}));
  EXPECT_EQ(numbers.shaded, 4);
  for (const float moved : {6.0f, 7.0f, 9.0f}) {
    numbers.relight(lamps({1, 2, moved, 8}));
    EXPECT_EQ(numbers.shaded, 1);
    EXPECT_EQ(numbers.cached, 3);
  }
  numbers.relight(lamps({1, 2, 9, 8}));  // it stopped
  EXPECT_EQ(numbers.shaded, 1);
  numbers.relight(lamps({1, 2, 9, 8}));
  EXPECT_EQ(numbers.shaded, 0);
}

// Red if a value is left out of the comparison, or the name is in it.
TEST(LightCache, EveryValueOfALightCountsButItsName) {
  const Light light = tiny::spot({0, 1, 0}, {0, -1, 0}, 10, 20);
  std::vector<Light> others(9, light);
  others[0].type = LightType::omni;
  others[1].position.x = 1;
  others[2].direction = {1, 0, 0};
  others[3].edge_u.x = 1;
  others[4].radius = 2;
  others[5].intensity.z = 2;
  others[6].inner_degrees = 11;
  others[7].outer_degrees = 21;
  others[8].casts_shadows = false;
  for (const Light& other : others) EXPECT_FALSE(same_light(light, other));
  Light renamed = light;
  renamed.name = "other";
  EXPECT_TRUE(same_light(light, renamed));
}

// Red if a failure between plan and done leaves a sum that was never made, or forget() forgets nothing.
TEST(LightCache, AFailureOrForgettingStartsAfresh) {
  Numbers numbers;
  numbers.relight(lamps({1, 2}));
  numbers.relight(lamps({1, 2}));
  numbers.cache.plan(lamps({1, 2, 4}));  // and then something throws
  EXPECT_EQ(numbers.relight(lamps({1, 2, 4})), 7.0f);
  EXPECT_EQ(numbers.shaded, 3);
  numbers.relight(lamps({1, 2, 4}));
  numbers.cache.forget();
  numbers.relight(lamps({1, 2, 4}));
  EXPECT_EQ(numbers.shaded, 3);
}

}  // namespace
}  // namespace relight
