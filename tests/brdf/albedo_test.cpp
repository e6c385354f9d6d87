// Energy: no surface reflects more than arrives, by quadrature and by sampling, and both agree.
#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "tests/brdf/brdf_cases.h"

namespace relight {
namespace {

const glm::vec3 n(0, 0, 1);

double albedo_by_quadrature(const shader::BrdfParams& brdf, const glm::vec3& wo) {
  return test::charts(brdf, wo).integrate([&](const glm::vec3& wi) {
    return wi.z > 0.0f ? double(shader::brdf_eval(brdf, n, wo, wi).x) * double(wi.z) : 0.0;
  });
}

// Mean and largest of f cos/pdf.
std::pair<double, double> albedo_by_sampling(const shader::BrdfParams& brdf, const glm::vec3& wo) {
  constexpr uint32_t samples = 1 << 15;
  double sum = 0.0, largest = 0.0;
  for (uint32_t i = 0; i < samples; ++i) {
    const BrdfSample s = sample_brdf(brdf, n, wo, random_float(5, 1, i, 0), sobol_2d(i, 3), false);
    if (!(s.pdf > 0.0f) || !(s.wi.z > 0.0f)) continue;
    const double value = double(shader::brdf_eval(brdf, n, wo, s.wi).x) * double(s.wi.z) / double(s.pdf);
    sum += value;
    largest = std::max(largest, value);
  }
  return {sum / samples, largest};
}

// White furnace: the albedo of the red channel (where diffuse + glossy is 1 in many cases) is at most 1. Red
// if a normalisation is too large, or Fresnel ignores what the diffuse part reflects (tried: rise to 1
// instead of 1 - k_d; A-S dividing by the smaller cosine).
TEST(Albedo, IsAtMostOneForEveryModelAndAngle) {
  for (const test::BrdfCase& c : test::brdf_cases())
    for (const glm::vec3& wo : test::eye_directions()) {
      const double albedo = albedo_by_quadrature(c.brdf, wo);
      EXPECT_LE(albedo, 1.002) << c.name << " cosine " << wo.z;
      EXPECT_GE(albedo, 0.0) << c.name << " cosine " << wo.z;
    }
}

// Red if evaluation and density disagree by a factor, or a part of the lobe is never sampled (tried: GGX
// density without the mask of the eye, or without its factor 1/2). Bound: four standard errors of the
// estimate if its terms reach their largest value, and 0.3 % for quadrature.
TEST(Albedo, BySamplingAgreesWithQuadrature) {
  for (const test::BrdfCase& c : test::brdf_cases())
    for (const glm::vec3& wo : test::eye_directions()) {
      const double expected = albedo_by_quadrature(c.brdf, wo);
      const auto [found, largest] = albedo_by_sampling(c.brdf, wo);
      const double bound = 4.0 * std::sqrt(largest * found / (1 << 15)) + 0.003 * expected + 1e-5;
      EXPECT_NEAR(found, expected, bound) << c.name << " cosine " << wo.z;
    }
}

// Sampling is importance sampling: the weight of a glossy sample never exceeds the lobe's reflectance. Red if
// half vectors are drawn from another distribution than the value has (tried: nu and nv exchanged in the
// density).
TEST(Albedo, WeightsOfGgxAndAshikhminShirleySamplesAreAtMostOne) {
  for (const test::BrdfCase& c : test::brdf_cases()) {
    const uint32_t model = shader::brdf_model(c.brdf.shape);
    if (model != shader::brdf_ggx && model != shader::brdf_ashikhmin_shirley) continue;
    if (c.brdf.diffuse != glm::vec3(0.0f)) continue;
    for (const glm::vec3& wo : test::eye_directions())
      EXPECT_LE(albedo_by_sampling(c.brdf, wo).second, 1.0005) << c.name << " cosine " << wo.z;
  }
}

}  // namespace
}  // namespace relight
