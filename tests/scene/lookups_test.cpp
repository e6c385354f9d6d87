// Texture and environment lookups, one texel at a time.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/scene/scene.h"

namespace relight {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Texture single_texel(int width, int height, int x, int y) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.texels.assign(static_cast<size_t>(width * height), glm::vec3(0.0f));
  texture.texels[static_cast<size_t>(y * width + x)] = glm::vec3(1.0f);
  return texture;
}

// Red with an offset of half a texel, swapped axes or a flipped v.
TEST(TextureSample, ReturnsEachTexelAtItsCentreAndHalfWayBetween) {
  constexpr int width = 4, height = 3;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Texture texture = single_texel(width, height, x, y);
      for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
          const glm::vec2 centre((i + 0.5f) / width, (j + 0.5f) / height);
          EXPECT_NEAR(texture.sample(centre).x, i == x && j == y ? 1.0f : 0.0f, 1e-5f);
        }
      EXPECT_NEAR(texture.sample({(x + 1.0f) / width, (y + 0.5f) / height}).x, 0.5f, 1e-5f);
      EXPECT_NEAR(texture.sample({(x + 0.5f) / width, (y + 1.0f) / height}).x, 0.5f, 1e-5f);
    }
}

// Red if negative or large coordinates clamp, mirror or leave the array.
TEST(TextureSample, WrapsAroundInBothDirections) {
  const Texture texture = single_texel(4, 3, 1, 2);
  const glm::vec2 centre(1.5f / 4.0f, 2.5f / 3.0f);
  for (const float shift : {-7.0f, -1.0f, 1.0f, 16.0f}) {
    EXPECT_NEAR(texture.sample(centre + glm::vec2(shift, 0.0f)).x, 1.0f, 1e-4f);
    EXPECT_NEAR(texture.sample(centre + glm::vec2(0.0f, shift)).x, 1.0f, 1e-4f);
  }
  EXPECT_TRUE(std::isfinite(texture.sample({-1e-9f, NAN}).x));
}

// Red if bilinear weights do not sum to one.
TEST(TextureSample, OfAConstantIsTheConstant) {
  Texture texture = single_texel(5, 7, 0, 0);
  texture.texels.assign(texture.texels.size(), glm::vec3(0.25f, 0.5f, 0.75f));
  for (int i = 0; i < 100; ++i) {
    const glm::vec3 c = texture.sample({0.037f * float(i), -0.071f * float(i)});
    EXPECT_NEAR(c.x, 0.25f, 1e-6f);
    EXPECT_NEAR(c.z, 0.75f, 1e-6f);
  }
}

// Direction of the centre of texel (x, y), written from the documentation of Environment.
glm::vec3 texel_direction(float x, float y, int width, int height) {
  const float azimuth = (x / float(width) - 0.5f) * 2.0f * pi, polar = y / float(height) * pi;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

Environment single_texel_sky(int width, int height, int x, int y) {
  Environment sky;
  sky.radiance = glm::vec3(2.0f);
  sky.width = width;
  sky.height = height;
  sky.texels = single_texel(width, height, x, y).texels;
  return sky;
}

// Red with half a texel, a mirrored azimuth, an upside-down map or a forgotten multiplier.
TEST(EnvironmentLookup, ReturnsEachTexelInItsDirection) {
  constexpr int width = 8, height = 4;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Environment sky = single_texel_sky(width, height, x, y);
      for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
          const glm::vec3 d = texel_direction(float(i) + 0.5f, float(j) + 0.5f, width, height);
          EXPECT_NEAR(sky.lookup(d).x, i == x && j == y ? 2.0f : 0.0f, 1e-4f);
        }
    }
}

// Red if the rotation turns the map the other way: +90 degrees about +y takes -z (u = 0.5) to -x.
TEST(EnvironmentLookup, RotationTurnsTheMapAboutYRightHanded) {
  constexpr int width = 8, height = 4;
  Environment sky = single_texel_sky(width, height, 4, 1);
  const glm::vec3 d = texel_direction(4.5f, 1.5f, width, height);
  sky.rotation_y = pi / 2.0f;
  const glm::vec3 turned_direction(d.z, d.y, -d.x);
  EXPECT_NEAR(sky.lookup(turned_direction).x, 2.0f, 1e-4f);
  EXPECT_NEAR(sky.lookup(d).x, 0.0f, 1e-4f);
}

// Red if the seam at u = 0 = 1 clamps instead of wrapping.
TEST(EnvironmentLookup, IsContinuousAcrossTheSeamAndDefinedAtThePoles) {
  const Environment sky = single_texel_sky(8, 4, 0, 1);
  const glm::vec3 seam = texel_direction(0.0f, 1.5f, 8, 4);
  EXPECT_NEAR(sky.lookup(seam).x, 1.0f, 1e-3f);
  for (const float y : {1.0f, -1.0f}) EXPECT_EQ(sky.lookup({0, y, 0}).x, 0.0f);
  Environment constant;
  constant.radiance = glm::vec3(0.0f, 3.0f, 0.0f);
  EXPECT_EQ(constant.lookup({0, 1, 0}).y, 3.0f);
}

}  // namespace
}  // namespace relight
