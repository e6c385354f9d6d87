// The split of the glossy part into a colour and a scalar lobe: where it is exact, and what it costs
// elsewhere.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "methods/direct_to_indirect/glossy_lobe.h"

namespace relight::direct_to_indirect {
namespace {

SurfaceSample surface(const GlossyPart& part, const glm::vec3& kd) {
  SurfaceSample s;
  s.shading_normal = s.geometric_normal = {0, 0, 1};
  s.diffuse = kd, s.glossy = part.glossy, s.exponent = part.exponent, s.shape = part.shape, s.valid = true;
  return s;
}

glm::vec3 eye_at(double cosine) { return 3.0f * glm::vec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine); }

// What the product k_g rho_g makes of the BRDF, by lobe samples.
struct Split {
  double error;             // relative L2 of k_g rho_g cos against f_g cos over the hemisphere, all channels
  glm::dvec3 albedo_ratio;  // of the product's directional albedo to the true one

  Split(const SurfaceSample& s, const glm::vec3& eye) {
    const GlossyLobe lobe(s, eye);
    const glm::vec3 kg = glossy_colour(s, eye, 1), wo = glm::normalize(eye);
    double d2 = 0.0, n2 = 0.0;
    glm::dvec3 product(0.0), exact(0.0);
    for (uint32_t k = 0; k < 20000; ++k) {
      const GlossyLobe::Sample sample = lobe.sample(random_float(1, 2, k, 0), sobol_2d(k, 77));
      if (!(sample.weight > 0.0f)) continue;
      const float cosine = sample.wi.z;
      const glm::dvec3 f(shader::brdf_glossy(s.brdf(), s.shading_normal, wo, sample.wi) * cosine);
      const glm::dvec3 p(kg * (lobe.value(sample.wi) * cosine));
      const double per_density = double(sample.weight) / double(lobe.value(sample.wi) * cosine);
      const glm::dvec3 d = p - f;
      d2 += glm::dot(d, d) * per_density, n2 += glm::dot(f, f) * per_density;
      product += p * per_density, exact += f * per_density;
    }
    error = std::sqrt(d2 / n2);
    albedo_ratio = product / exact;
  }
};

const glm::vec3 gold(1.0f, 0.71f, 0.29f), paint(0.5f, 0.2f, 0.05f);

// Red if the lobe is scaled by one channel, or k_g is not `glossy` (tried: normalised by the largest
// channel).
TEST(GlossyLobe, IsExactForPhongAndForGreySurfaces) {
  for (const double cosine : {1.0, 0.5, 0.05}) {
    EXPECT_LT(Split(surface(phong_part(gold, 40.0f), paint), eye_at(cosine)).error, 1e-5);
    for (const GlossyPart& part :
         {ggx_part(glm::vec3(0.2f), 0.3f, 0.3f), ashikhmin_shirley_part(glm::vec3(0.2f), 10.0f, 100.0f)})
      EXPECT_LT(Split(surface(part, glm::vec3(0.3f)), eye_at(cosine)).error, 1e-5);
  }
}

// Light of equal radiance from everywhere has the right colour. The bound is the noise of the ratio of
// channels, which varies by up to 13 % over a lobe (below), after 64 samples. Red if k_g is `glossy`
// (tried).
TEST(GlossyLobe, ReflectsEvenLightInTheRightColourWhateverFresnelDoes) {
  for (const double cosine : {1.0, 0.5, 0.2, 0.05})
    for (const GlossyPart& part : {ggx_part(gold, 0.5f, 0.5f), ggx_part(gold, 0.05f, 0.05f),
                                   ashikhmin_shirley_part(gold, 10.0f, 10.0f),
                                   ashikhmin_shirley_part(glm::vec3(0.04f), 300.0f, 300.0f)})
      for (const glm::vec3& kd : {glm::vec3(0.0f), paint}) {
        const Split split(surface(part, kd), eye_at(cosine));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(split.albedo_ratio[c], 1.0, 0.02) << cosine;
      }
}

// How far a coloured Fresnel term is from a product, in L2 over the lobe of a metal. Measured, for alpha
// 0.05, 0.2, 0.5 and 1: at most 0.1 % with the eye at a cosine of 0.9, 1.5 % at 0.5, 7 % at 0.2, 13 % at
// 0.05. Red if k_g is `glossy` (tried).
TEST(GlossyLobe, CostsTwoPercentUpToSixtyDegreesAndMoreOnlyAtGrazingEyes) {
  for (const float alpha : {0.05f, 0.2f, 0.5f, 1.0f}) {
    std::printf("gold, GGX alpha %.2f:", double(alpha));
    for (const double cosine : {0.9, 0.5, 0.2, 0.05}) {
      const double error =
          Split(surface(ggx_part(gold, alpha, alpha), glm::vec3(0.0f)), eye_at(cosine)).error;
      std::printf(" %.4f", error);
      EXPECT_LT(error, cosine >= 0.5 ? 0.02 : 0.15) << alpha << ' ' << cosine;
    }
    std::printf("\n");
  }
}

// The walk's bound must not miss the peak. Red if the rotation goes the wrong way (tried).
TEST(GlossyLobe, LargestInAConeIsTheValueInItsDirectionClosestToTheMirror) {
  const SurfaceSample s = surface(phong_part(gold, 200.0f), paint);
  const glm::vec3 eye = eye_at(0.6), mirror = glm::normalize(glm::vec3(-eye.x, -eye.y, eye.z));
  const GlossyLobe lobe(s, eye);
  const auto turned = [&](float angle) {  // in the plane of incidence, away from the normal
    return glm::normalize(std::cos(angle) * mirror + std::sin(angle) * glm::vec3(mirror.z, 0.0f, -mirror.x));
  };
  for (const float aside : {-0.3f, -0.1f, 0.02f, 0.1f, 0.25f})
    for (const float b : {0.01f, 0.05f, 0.4f}) {
      double largest = 0.0;
      for (int k = -100; k <= 100; ++k) {
        const glm::vec3 wi = turned(aside + b * static_cast<float>(k) / 100.0f);
        if (wi.z > 0.0f) largest = std::max(largest, double(lobe.value(wi) * wi.z));
      }
      const double bound = double(lobe.largest_in_cone(turned(aside), std::cos(b), std::sin(b)));
      EXPECT_GE(bound, 0.999 * largest) << aside << ' ' << b;
      EXPECT_LE(bound, largest * (1.0 + 5.0 * std::sin(double(b))))
          << aside << ' ' << b;  // cosines of the far side
    }
}

}  // namespace
}  // namespace relight::direct_to_indirect
