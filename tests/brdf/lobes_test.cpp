// From usual parameters to packed ones: what is rounded, what is refused, how bright a material can get.
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/brdf/brdf_cases.h"

namespace relight {
namespace {

// Red if rounding the shares creates or loses energy, or lets a lobe that is not there have some (tried:
// shares rounded each by itself).
TEST(LafortuneParts, AddUpToTheGlossyColourExactly) {
  const LafortuneLobe lobes[3] = {{-1, -1, 1, 5, {0.1f, 0.2f, 0.7f}},
                                  {-1, -1, 1, 9, {0.3f, 0.1f, 0.7f}},
                                  {-1, -1, 1, 7, {0.2f, 0.1f, 0.1f}}};
  for (size_t count = 1; count <= 3; ++count) {
    const shader::BrdfParams brdf = test::with_part(glm::vec3(0.0f), lafortune_part({lobes, count}));
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 weight = shader::lafortune_weight(brdf, k);
      sum += weight;
      for (int channel = 0; channel < 3; ++channel) {
        const float expected = size_t(k) < count ? lobes[k].albedo[channel] : 0.0f;
        EXPECT_NEAR(weight[channel], expected, size_t(k) < count ? brdf.glossy[channel] / 1023.0f : 0.0f)
            << count << k;
      }
    }
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(sum[channel], brdf.glossy[channel], 1e-6f) << count;
  }
}

// Red if a value that floats, halves or the energy bound cannot hold passes (tried: no check of the exponent,
// of cx and cy).
TEST(LafortuneParts, RefuseWhatTheyCannotHold) {
  const auto part = [](std::vector<LafortuneLobe> lobes) { return lafortune_part(lobes); };
  EXPECT_THROW(part({}), std::invalid_argument);
  EXPECT_THROW(part(std::vector<LafortuneLobe>(4)), std::invalid_argument);
  EXPECT_THROW(part({{-1, -1, 0, 1, glm::vec3(0.1f)}}), std::invalid_argument);
  EXPECT_THROW(part({{-1, -1, -1, 1, glm::vec3(0.1f)}}), std::invalid_argument);
  EXPECT_THROW(part({{-9, -1, 1, 1, glm::vec3(0.1f)}}), std::invalid_argument);
  EXPECT_THROW(part({{std::numeric_limits<float>::quiet_NaN(), -1, 1, 1, glm::vec3(0.1f)}}),
               std::invalid_argument);
  EXPECT_THROW(part({{-1, -1, 1, -1, glm::vec3(0.1f)}}), std::invalid_argument);
  EXPECT_THROW(part({{-1, -1, 1, 1, glm::vec3(-0.1f)}}), std::invalid_argument);
}

// Red if lobes that grow towards the horizon are taken for harmless (tried: largest_albedo = glossy).
TEST(LafortuneParts, LargestAlbedoBoundsTheAlbedoAtEveryAngle) {
  for (float ratio : {-1.0f, -1.1f, -1.4f, 1.2f})
    for (float exponent : {1.0f, 20.0f, 60.0f}) {
      const LafortuneLobe lobe{ratio, ratio, 1.0f, exponent, glm::vec3(0.5f)};
      const GlossyPart part = lafortune_part({&lobe, 1});
      const shader::BrdfParams brdf = test::with_part(glm::vec3(0.0f), part);
      const float bound = largest_albedo(part).x;
      double largest = 0.0;
      for (double cosine : {1.0, 0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.03}) {
        const glm::vec3 wo = test::direction(cosine, 0.4);
        largest = std::max(largest, test::charts(brdf, wo).integrate([&](const glm::vec3& wi) {
          return wi.z > 0.0f ? double(shader::brdf_glossy(brdf, {0, 0, 1}, wo, wi).x) * double(wi.z) : 0.0;
        }));
      }
      EXPECT_LE(largest, 1.01 * double(bound)) << ratio << ' ' << exponent;
      EXPECT_GE(largest, 0.9 * double(bound)) << ratio << ' ' << exponent;
    }
}

// Red if roughness 0 gives a lobe that floats cannot sample (tried).
TEST(GgxParts, ClampAlphaToWhatFloatsCanSample) {
  EXPECT_EQ(ggx_part(glm::vec3(0.5f), 0.0f, 2.0f).exponent, smallest_alpha);
  EXPECT_EQ(ggx_part(glm::vec3(0.5f), 0.0f, 2.0f).shape.exponent_v, 1.0f);
}

}  // namespace
}  // namespace relight
