#include "common/shading/light_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sampling/random.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

using test::omni_light;
using test::spot_light;

// Directions into which the light sends anything.
bool emits(const Light& light, const glm::vec3& away) {
  return shader::light_intensity(light.params(), away) != glm::vec3(0.0f);
}

bool covered(const LightFrame& frame, const glm::vec3& v) {
  for (int i = 0; i < frame.faces; ++i) {
    const ShadowFace f = frame.face(i);
    const float limit = frame.tan_half * glm::dot(f.forward, v) * (1.0f + 1e-6f);
    if (limit > 0.0f && std::abs(glm::dot(f.right, v)) <= limit && std::abs(glm::dot(f.up, v)) <= limit)
      return true;
  }
  return false;
}

// Red if a face is missing, doubled or turned, or the single map is narrower than the cone.
TEST(LightFrame, MapsCoverEveryDirectionThatGetsLight) {
  for (const float outer : {0.05f, 10.0f, 45.0f, 60.0f, 61.0f, 75.0f, 89.5f}) {
    const Light spot = spot_light({0, 0, 0}, {0.3f, -0.8f, 0.5f}, outer);
    const LightFrame frame = light_frame(emitter_of(spot), 10.0f, 64);
    EXPECT_EQ(frame.faces, outer <= 60.0f ? 1 : 5) << outer;
    for (uint64_t i = 0; i < 4000; ++i) {
      const glm::vec3 v =
          glm::vec3(random_float(1, 0, i, 0), random_float(1, 0, i, 1), random_float(1, 0, i, 2)) - 0.5f;
      const glm::vec3 near_axis =
          glm::normalize(glm::normalize(spot.direction) + v * (outer < 1.0f ? 0.003f : 3.0f));
      EXPECT_TRUE(!emits(spot, near_axis) || covered(frame, near_axis)) << outer;
    }
  }
  const LightFrame omni = light_frame(emitter_of(omni_light({0, 0, 0})), 10.0f, 64);
  for (uint64_t i = 0; i < 4000; ++i) {
    const glm::vec3 v =
        glm::vec3(random_float(2, 0, i, 0), random_float(2, 0, i, 1), random_float(2, 0, i, 2)) - 0.5f;
    EXPECT_TRUE(covered(omni, v));
  }
}

// Red if the axes are not orthonormal for an axis along, or almost along, a coordinate axis.
TEST(LightFrame, AxesAreOrthonormalForAnyDirection) {
  for (const glm::vec3& d : {glm::vec3(0, -1, 0), glm::vec3(0, 0, 2), glm::vec3(1, 0, 0),
                             glm::vec3(1e-6f, -1, 1e-7f), glm::vec3(-3, 4, 5)}) {
    const LightFrame frame = light_frame(emitter_of(spot_light({1, 2, 3}, d, 30.0f)), 10.0f, 64);
    EXPECT_LT(glm::length(frame.axes[2] - glm::normalize(d)), 1e-6f);
    const glm::mat3 product = glm::transpose(frame.axes) * frame.axes;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(product[i][k], i == k ? 1.0f : 0.0f, 1e-6f);
    }
  }
}

// Red if the near plane is absolute, or zero for a scene without extent.
TEST(LightFrame, TheNearPlaneScalesWithTheScene) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    const LightFrame frame = light_frame(emitter_of(omni_light({0, 0, 0})), 10.0f * scale, 64);
    EXPECT_GT(frame.near, 1e-6f * scale);
    EXPECT_LT(frame.near, 1e-4f * scale);
  }
  EXPECT_GT(light_frame(emitter_of(omni_light({0, 0, 0})), 0.0f, 64).near, 0.0f);
}

}  // namespace
}  // namespace relight
