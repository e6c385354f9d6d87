// Environment maps lit one texel at a time: half a texel of error anywhere shows.
#include "reference/environment_sampler.h"
#include "tests/reference/skies.h"
#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::tiny {
namespace {

constexpr int width = 16, height = 8;

struct Texel {
  int column, row;
  float rotation;
};
void PrintTo(const Texel& t, std::ostream* out) { *out << t.column << "_" << t.row << "_" << t.rotation; }

class OneTexel : public testing::TestWithParam<Texel> {
 protected:
  Texel t_ = GetParam();
  Environment map_ = one_texel(width, height, t_.column, t_.row, t_.rotation, {3.0f, 2.0f, 1.0f});
  glm::dvec2 centre_{t_.column + 0.5, t_.row + 0.5};
  // Distance from the texel's centre in texels, around the seam where that is nearer.
  glm::dvec2 away(const glm::dvec3& d) const {
    const glm::dvec2 by = glm::abs(place_in_map(map_, d) - centre_);
    return {std::min(by.x, width - by.x), by.y};
  }
  // Integral of lookup x f over the texels that its light reaches.
  template <typename Function>
  glm::dvec3 integral(Function f) const {
    const glm::ivec2 first(t_.column - 1, std::max(t_.row - 1, 0)),
        last(t_.column + 1, std::min(t_.row + 1, height - 1));
    return integrate_map(map_, first, last, 48,
                         [&](const glm::dvec3& d) { return glm::dvec3(map_.lookup(glm::vec3(d))) * f(d); });
  }
};

// Inside, at the seam, at the poles, in the corners.
INSTANTIATE_TEST_SUITE_P(Places, OneTexel,
                         testing::Values(Texel{5, 3, 0.0f}, Texel{0, 3, 0.0f}, Texel{width - 1, 4, 0.0f},
                                         Texel{9, 0, 0.0f}, Texel{4, height - 1, 0.0f}, Texel{0, 0, 0.0f},
                                         Texel{width - 1, height - 1, 0.0f}, Texel{5, 3, 1.3f},
                                         Texel{0, 4, -2.0f}, Texel{width - 1, 2, 7.5f}, Texel{9, 0, 2.5f}));

// The light of a texel ends one texel from its centre, its samples one and a half. Red if (tried): the
// sampler turns the other way than lookup(), is mirrored, or shifted by a texel.
TEST_P(OneTexel, DrawsAllSamplesFromTheTexelAndItsNeighbours) {
  const EnvironmentSampler sampler(map_);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> u(0.0f, 0.99999f);
  int lit = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const glm::vec3 d = sampler.sample({u(random), u(random)}).direction;
    const glm::dvec2 by = away(glm::dvec3(d));
    ASSERT_LE(by.x, 1.5 + 1e-4);
    ASSERT_LE(by.y, 1.5 + 1e-3);
    lit += map_.lookup(d).x > 0.0f;
  }
  // (6/8 + 1/8)^2 = 0.77 of them, but for the changing size of rows; far from what any shift would leave.
  EXPECT_GT(lit, 0.7 * n);
}

// Red if (tried): a texel's share does not count its neighbours (the rim of its light is never sampled).
TEST_P(OneTexel, HasADensityWhereverItsLightReaches) {
  const EnvironmentSampler sampler(map_);
  for (int j = 0; j < 16 * height; ++j)
    for (int i = 0; i < 16 * width; ++i) {
      const glm::vec3 d(direction_at(map_, {(i + 0.5) / 16.0, (j + 0.5) / 16.0}));
      ASSERT_TRUE(map_.lookup(d).x == 0.0f || sampler.pdf(d) > 0.0f) << i << " " << j;
    }
}

// Mean of lookup / pdf against quadrature: 5 standard errors, a false alarm in 2e6. Red if (tried): samples
// come with the pdf of the row above.
TEST_P(OneTexel, EstimatesItsWholeLight) {
  const EnvironmentSampler sampler(map_);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> u(0.0f, 0.99999f);
  const int n = 40000;
  double mean = 0.0, squares = 0.0;
  for (int i = 1; i <= n; ++i) {
    const EnvironmentSample sample = sampler.sample({u(random), u(random)});
    const double x = static_cast<double>(map_.lookup(sample.direction).x / sample.pdf), before = x - mean;
    mean += before / i;
    squares += before * (x - mean);
  }
  const double expected = integral([](const glm::dvec3&) { return 1.0; }).x;
  const double error = std::sqrt(squares / n / (n - 1.0));
  EXPECT_LT(std::abs(mean - expected), 5.0 * error + 1e-3 * expected) << mean << " against " << expected;
  EXPECT_LT(error, 0.01 * expected) << "too noisy to tell";
}

// A diffuse plate that faces the texel a little askew; radiance is albedo / pi x the quadrature of lookup x
// cosine (48 x 48 points a texel: within 0.1 %). Red if (tried): light from a drawn
// direction is divided by the BRDF's density alone, or the rows' sum is off by 1 %.
TEST_P(OneTexel, LightsAPlateAsQuadratureOverTheLookupSays) {
  const glm::dvec3 n = glm::normalize(direction_at(map_, centre_) + glm::dvec3(0.3, 0.2, -0.25));
  const glm::dvec3 a = glm::normalize(glm::cross(n, glm::dvec3(0.36, 0.48, 0.8))), b = glm::cross(n, a);
  Scene scene = empty_scene(glm::vec3(0.6f));
  add_quad(scene, glm::vec3(-a - b), glm::vec3(2.0 * a), glm::vec3(2.0 * b));
  scene.environment = map_;
  finish_scene(scene);
  const check::RadianceMeter meter(std::move(scene), {});
  const check::Reading reading =
      meter.read(glm::vec3(0.5 * n + 0.2 * a), glm::vec3(0.0f), {0, 0, false, true}, {256, 24});
  const glm::dvec3 expected =
      0.6 / M_PI * integral([&](const glm::dvec3& d) { return std::max(0.0, glm::dot(n, d)); });
  expect_reads(reading, expected, 1e-3 * expected, 0.02);
}

}  // namespace
}  // namespace relight::tiny
