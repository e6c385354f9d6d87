// Values against the papers' formulas, written anew in double precision; reciprocity; symmetries.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "tests/brdf/brdf_cases.h"

namespace relight {
namespace {

constexpr double pi = std::numbers::pi;
const glm::vec3 n(0, 0, 1);

const glm::dvec3 pairs[][2] = {{glm::dvec3(0.3, 0.1, 0.9), glm::dvec3(-0.2, 0.05, 0.8)},
                               {glm::dvec3(0.9, -0.3, 0.2), glm::dvec3(-0.8, 0.4, 0.3)},
                               {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, 1.0)},
                               {glm::dvec3(0.5, 0.5, 0.5), glm::dvec3(0.5, 0.5, 0.5)},
                               {glm::dvec3(0.7, 0.0, 0.01), glm::dvec3(-0.1, 0.6, 0.1)}};

double fresnel(double f0, double f90, double cosine) { return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0); }

void expect_value(const shader::BrdfParams& brdf, const glm::dvec3& o, const glm::dvec3& i, double expected) {
  const double found = shader::brdf_glossy(brdf, n, glm::vec3(o), glm::vec3(i)).x;
  EXPECT_NEAR(found, expected, 2e-4 * expected + 1e-12) << o.z << ' ' << i.z;
}

// Ashikhmin and Shirley 2000, equation 4. Red if nu and nv are exchanged, or the smaller cosine divides (both
// tried).
TEST(Formula, AshikhminShirleyIsThePapersEquation) {
  const double nu = 10, nv = 100, f0 = 0.2, kd = 0.3;
  for (const auto& [a, b] : pairs) {
    const glm::dvec3 o = glm::normalize(a), i = glm::normalize(b), h = glm::normalize(o + i);
    const double power = h.z < 1.0 ? (nu * h.x * h.x + nv * h.y * h.y) / (1.0 - h.z * h.z) : 0.0;
    const double expected = std::sqrt((nu + 1) * (nv + 1)) / (8 * pi) * std::pow(h.z, power) /
                            (glm::dot(h, o) * std::max(o.z, i.z)) * fresnel(f0, 1.0 - kd, glm::dot(h, o));
    expect_value(test::with_part(glm::vec3(float(kd)), ashikhmin_shirley_part(glm::vec3(float(f0)), 10, 100)),
                 o, i, expected);
  }
}

// Heitz 2014 with slopes and tangents: D (equation 85), Lambda (72), height-correlated G2 (99). Red if one
// direction is not masked, an alpha is squared twice, or the alphas are exchanged (all tried).
TEST(Formula, GgxIsHeitzsEquation) {
  const double au = 0.2, av = 0.5, f0 = 0.6;
  const auto lambda = [&](const glm::dvec3& w) {
    return 0.5 * (std::sqrt(1.0 + (au * au * w.x * w.x + av * av * w.y * w.y) / (w.z * w.z)) - 1.0);
  };
  for (const auto& [a, b] : pairs) {
    const glm::dvec3 o = glm::normalize(a), i = glm::normalize(b), h = glm::normalize(o + i);
    const double sx = h.x / h.z / au, sy = h.y / h.z / av;
    const double d = 1.0 / (pi * au * av * std::pow(h.z, 4) * std::pow(1.0 + sx * sx + sy * sy, 2));
    const double expected =
        d * fresnel(f0, 1.0, glm::dot(h, o)) / (1.0 + lambda(o) + lambda(i)) / (4.0 * o.z * i.z);
    expect_value(test::with_part(glm::vec3(0.0f), ggx_part(glm::vec3(float(f0)), 0.2f, 0.5f)), o, i,
                 expected);
  }
}

// Lafortune et al. 1997, equation 7, each lobe normalised to its albedo at normal incidence. Red if lobes
// exchange exponents, ratios or shares (tried: the second share given to the third lobe too). The albedos are
// multiples of 1/1023 of their sum.
TEST(Formula, LafortuneIsTheSumOfItsLobes) {
  const std::vector<LafortuneLobe> lobes = {{-1.0f, -0.75f, 1.0f, 12.0f, glm::vec3(0.25f)},
                                            {0.5f, 0.5f, 2.0f, 3.0f, glm::vec3(0.75f * 6.0f / 11.0f)},
                                            {0.0f, 0.25f, 1.0f, 40.0f, glm::vec3(0.75f * 4.0f / 33.0f)}};
  const shader::BrdfParams brdf = test::with_part(glm::vec3(0.1f), lafortune_part(lobes));
  for (const auto& [a, b] : pairs) {
    const glm::dvec3 o = glm::normalize(a), i = glm::normalize(b);
    double expected = 0.0;
    for (size_t k = 0; k < 3; ++k) {
      const LafortuneLobe& lobe = lobes[k];
      const double c =
          double(lobe.cx) * o.x * i.x + double(lobe.cy) * o.y * i.y + double(lobe.cz) * o.z * i.z;
      const double e = double(lobe.exponent);
      if (c > 0.0) expected += double(lobe.albedo.x) * (e + 2) / (2 * pi) * std::pow(c / double(lobe.cz), e);
    }
    expect_value(brdf, o, i, expected);
  }
}

// Red if the C = (-1,-1,1) lobe isn't the mirror lobe (tried: the sign of C_x).
TEST(Formula, ALafortuneLobeWithRatiosOfMinusOneIsPhong) {
  const shader::BrdfParams phong = test::with_part(glm::vec3(0.2f), phong_part({0.5f, 0.4f, 0.3f}, 25.0f));
  const LafortuneLobe lobe{-2.0f, -2.0f, 2.0f, 25.0f, {0.5f, 0.4f, 0.3f}};
  const shader::BrdfParams lafortune = test::with_part(glm::vec3(0.2f), lafortune_part({&lobe, 1}), 0.8f);
  for (const auto& [a, b] : pairs) {
    const glm::vec3 o(glm::normalize(a)), i(glm::normalize(b));
    const float expected = shader::brdf_eval(phong, n, o, i).y;
    EXPECT_NEAR(shader::brdf_eval(lafortune, n, o, i).y, expected, 2e-5f * expected);
    EXPECT_NEAR(brdf_pdf(lafortune, n, o, i, false), brdf_pdf(phong, n, o, i, false), 1e-4f);
  }
}

// Helmholtz reciprocity, near the mirror direction and away from it. Red if a lobe depends on which direction
// is which: light and eye sub-paths would disagree (tried: GGX masking of one direction only; A-S dividing by
// o.z).
TEST(Reciprocity, HoldsForEveryModel) {
  for (const test::BrdfCase& c : test::brdf_cases())
    for (uint32_t k = 0; k < 400; ++k) {
      const glm::vec3 normal = test::direction(2.0 * double(random_float(4, 0, k, 0)) - 1.0, k);
      const glm::mat3 frame = frame_around(normal);
      const glm::vec3 wo = frame * test::direction(k % 5 ? sobol_2d(k, 5).x : 1e-3, k * 0.7);
      // Every other pair within the lobe.
      glm::vec3 wi = frame * test::direction(sobol_2d(k, 6).x, k * 1.3);
      if (k % 2) wi = sample_brdf(c.brdf, normal, wo, 0.0f, sobol_2d(k, 7), false).wi;
      if (!(glm::dot(wi, normal) > 0.0f) || !(glm::dot(wo, normal) > 0.0f)) continue;
      const glm::vec3 forth = shader::brdf_eval(c.brdf, normal, wo, wi);
      const glm::vec3 back = shader::brdf_eval(c.brdf, normal, wi, wo);
      // Half vectors are symmetric to the last bit. The others raise a cosine with an error of 3e-7 to their
      // exponent.
      const uint32_t model = shader::brdf_model(c.brdf.shape);
      if (model == shader::brdf_ggx || model == shader::brdf_ashikhmin_shirley) {
        EXPECT_EQ(forth, back) << c.name << ' ' << k;
      } else {
        EXPECT_NEAR(forth.x, back.x, (1e-5f + 5e-7f * c.brdf.exponent) * forth.x + 1e-6f)
            << c.name << ' ' << k;
      }
    }
}

// Red if an isotropic material depends on the tangent, or the tangent turns the frame the wrong way (tried:
// the sign of the sine).
TEST(Anisotropy, FollowsTheTangentAndOnlyForAnisotropicMaterials) {
  for (const test::BrdfCase& c : test::brdf_cases()) {
    const GlossyPart part{c.brdf.glossy, c.brdf.exponent, c.brdf.shape};
    shader::BrdfParams turned = c.brdf;
    turned.shape.tangent += 0.5f;
    const glm::vec3 o = test::direction(0.8, 0.3), i = test::direction(0.75, 3.6);
    const glm::vec3 o_turned = test::direction(0.8, 0.8), i_turned = test::direction(0.75, 4.1);
    const float value = shader::brdf_glossy(c.brdf, n, o, i).x;
    EXPECT_NEAR(shader::brdf_glossy(turned, n, o_turned, i_turned).x, value,
                (1e-4f + 1e-6f * part.exponent) * value)
        << c.name;
    if (part.anisotropic() && value > 1e-6f) {
      EXPECT_GT(std::abs(shader::brdf_glossy(turned, n, o, i).x - value), 0.01f * value) << c.name;
    } else if (!part.anisotropic() && part.exponent < 1e4f && (part.exponent > 0.01f || value == 0.0f)) {
      EXPECT_NEAR(shader::brdf_glossy(turned, n, o, i).x, value, 1e-3f * value) << c.name;
    }
  }
}

// The lobe is wide where the exponent is small and alpha large. Red if u and v are exchanged (tried for both
// models).
TEST(Anisotropy, TheLobeIsWideAlongTheRoughDirection) {
  const glm::vec3 o(0, 0, 1), along_u = test::direction(0.95, 0.0), along_v = test::direction(0.95, pi / 2);
  for (const GlossyPart& part :
       {ashikhmin_shirley_part(glm::vec3(0.5f), 10, 100), ggx_part(glm::vec3(0.5f), 0.4f, 0.1f)}) {
    const shader::BrdfParams brdf = test::with_part(glm::vec3(0.0f), part);
    EXPECT_GT(shader::brdf_glossy(brdf, n, o, along_u).x, 2.0f * shader::brdf_glossy(brdf, n, o, along_v).x);
  }
}

}  // namespace
}  // namespace relight
