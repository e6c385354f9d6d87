// Projectors and uber-lights against their formulas in double precision, written down again here.
#include <cmath>

#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "tests/lights/light_cases.h"

namespace relight {
namespace {

double smooth(double t) {
  const double s = std::min(1.0, std::max(0.0, t));
  return s * s * (3.0 - 2.0 * s);
}

double norm(double u, double v, double roundness) {
  const double p = 2.0 / roundness;
  return roundness == 0.0 ? std::max(u, v) : std::pow(std::pow(u, p) + std::pow(v, p), 1.0 / p);
}

// The shape by its definition: along the ray through (x, y), smooth between where it leaves the inner and the
// outer curve.
double shape(const BeamShape& b, double x, double y) {
  const double n_in =
      norm(std::abs(x) / double(b.width), std::abs(y) / double(b.height), double(b.roundness));
  const double n_out = norm(std::abs(x) / double(b.width + b.width_edge),
                            std::abs(y) / double(b.height + b.height_edge), double(b.roundness));
  const double inner = 1.0 / n_in, outer = 1.0 / n_out;  // in units of (x, y)
  if (inner >= 1.0) return 1.0;
  if (outer <= 1.0) return 0.0;
  return 1.0 - smooth((1.0 - inner) / (outer - inner));
}

glm::dvec3 texel(const Slide& s, int x, int y) {
  x = std::clamp(x, 0, s.width - 1), y = std::clamp(y, 0, s.height - 1);
  return glm::dvec3(s.texels[size_t(y) * size_t(s.width) + size_t(x)]);
}

glm::dvec3 bilinear(const Slide& s, double u, double v) {
  const double x = std::clamp(u * s.width - 0.5, 0.0, s.width - 1.0),
               y = std::clamp(v * s.height - 0.5, 0.0, s.height - 1.0);
  const int i = int(x), j = int(y);
  return glm::mix(glm::mix(texel(s, i, j), texel(s, i + 1, j), x - i),
                  glm::mix(texel(s, i, j + 1), texel(s, i + 1, j + 1), x - i), y - j);
}

// Irradiance of a point at `p` that faces the light.
glm::dvec3 expected(const Light& light, const glm::dvec3& p) {
  const BeamShape& b = light.beam;
  const glm::dvec3 rel = p - glm::dvec3(light.position), forward(light.direction), right(light.right);
  const double depth = glm::dot(rel, forward), r = glm::length(rel);
  if (!(depth > 0.0)) return glm::dvec3(0.0);
  const double x = glm::dot(rel, right) / depth - double(b.shear_x),
               y = glm::dot(rel, glm::cross(right, forward)) / depth - double(b.shear_y);
  double factor = shape(b, x, y);
  factor *= depth >= double(b.cut_on)
                ? 1.0
                : smooth((depth - double(b.cut_on - b.near_edge)) / double(b.near_edge));
  factor *= depth <= double(b.cut_off) ? 1.0 : 1.0 - smooth((depth - double(b.cut_off)) / double(b.far_edge));
  factor *= std::pow(double(b.falloff_distance) / r, double(b.falloff)) /
            (double(b.falloff_distance) * double(b.falloff_distance));
  const glm::dvec3 slide =
      bilinear(*light.slide, 0.5 + 0.5 * x / double(b.width), 0.5 - 0.5 * y / double(b.height));
  return glm::dvec3(light.intensity) * factor * slide;
}

// All places in front of the lights, facing them. Stated bound: 2e-4 of the bare light there, for the slope
// of the fading edges. Samples within 1e-4 of a hard edge are left out. Red if (tried): shear has the other
// sign; the slide is mirrored or upside down; the near and far cut are exchanged; falloff ignores its
// distance.
void expect_formula(const Light& light) {
  SCOPED_TRACE(light.name);
  const Emitter emitter = emitter_of(light);
  int lit = 0, dark = 0, faded = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const auto u = [i](uint64_t d) { return 2.0f * random_float(8, 1, i, d) - 1.0f; };
    const glm::vec3 p = light.position + 2.5f * glm::vec3(u(0), u(1), u(2));
    const glm::vec3 n = glm::normalize(light.position - p);
    const glm::dvec3 e = expected(light, glm::dvec3(p));
    const glm::vec3 got = emitter.irradiance(p, n, n);
    const double bare =
        double(light.intensity.x) *
        double(std::max(1.0f, std::pow(glm::length(p - light.position), 2.0f - light.beam.falloff))) /
        double(glm::dot(p - light.position, p - light.position));
    const double near_edge = std::abs(e.x - expected(light, glm::dvec3(p) * (1.0 + 3e-6)).x) / bare;
    if (near_edge > 1e-3) continue;
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(double(got[c]), e[c], bare * 2e-4 + 1e-12) << i;
    lit += e.x > 0.0, dark += e.x == 0.0, faded += e.x > 0.0 && e.x < 0.5 * bare;
  }
  EXPECT_GT(lit, 500);
  EXPECT_GT(dark, 5000);
  EXPECT_GT(faded, 50);
}

TEST(Beam, OfAProjectorIsItsFormula) {
  expect_formula(test::projector_light({0.3f, 1.4f, 0.9f}, {0, -0.7f, -1}));
}

TEST(Beam, OfAnUberLightIsItsFormula) {
  for (const float roundness : {0.0f, 0.05f, 0.5f, 1.0f}) {
    Light light = test::uber_light({0.3f, 1.4f, 0.9f}, {0.2f, -0.7f, -1});
    light.beam.roundness = roundness;
    expect_formula(light);
    light.beam.falloff = 0.5f, light.beam.falloff_distance = 0.7f;
    expect_formula(light);
  }
}

// An ellipse and a rectangle at points that can be checked by hand. Red if (tried): the norm's exponent is
// the roundness itself.
TEST(Beam, ShapesAreWhatTheyAreCalled) {
  Light light = test::uber_light({0, 0, 0}, {0, 0, -1});
  light.right = {1, 0, 0};
  light.beam = {0.5f, 0.25f, 0.0f, 0.0f, 1.0f};
  light.slide = nullptr;
  const auto at = [&](float x, float y) {
    return emitter_of(light).beam->factor(light.right * x + glm::vec3(0, y, -1)).x;
  };
  EXPECT_EQ(at(0.49f, 0.0f), 1.0f);
  EXPECT_EQ(at(0.51f, 0.0f), 0.0f);
  EXPECT_EQ(at(0.4f, 0.14f), 1.0f);  // (0.8)^2 + (0.56)^2 < 1
  EXPECT_EQ(at(0.4f, 0.16f), 0.0f);  // (0.8)^2 + (0.64)^2 > 1
  light.beam.roundness = 0.0f;
  EXPECT_EQ(at(0.49f, 0.24f), 1.0f);
  EXPECT_EQ(at(0.4f, 0.26f), 0.0f);
  light.beam.shear_x = 0.3f;
  EXPECT_EQ(at(0.79f, 0.0f), 1.0f);
  EXPECT_EQ(at(-0.21f, 0.0f), 0.0f);
}

// Seen from the projector along its axis, the picture stands as the file shows it. Red if (tried): mirrored.
TEST(Beam, TheSlideStandsUpright) {
  Light light = test::projector_light({0, 0, 0}, {0, 0, -1});
  Slide slide;
  slide.width = slide.height = 2;
  slide.texels = {glm::vec4(1), glm::vec4(2), glm::vec4(3), glm::vec4(4)};  // upper row, then lower row
  light.slide = std::make_shared<const Slide>(slide);
  light.beam.width = light.beam.height = 0.5f;
  const auto at = [&](float x, float y) { return emitter_of(light).beam->factor({x, y, -1}).x; };
  EXPECT_FLOAT_EQ(at(-0.4f, 0.4f), 1.0f);  // upper left: looking along -z, +x is on the right
  EXPECT_FLOAT_EQ(at(0.4f, 0.4f), 2.0f);
  EXPECT_FLOAT_EQ(at(-0.4f, -0.4f), 3.0f);
  EXPECT_FLOAT_EQ(at(0.0f, 0.0f), 2.5f);
}

// Light outside the cone that shadow maps, culling and light paths rely on would be lost. Red if (tried): the
// cone forgets edges or shear.
TEST(Beam, LiesInTheConeOfItsEmitter) {
  Light light = test::uber_light({0, 0, 0}, {0.2f, -0.7f, -1});
  light.beam.shear_x = 0.4f;
  for (const Light& l : {light, test::projector_light({0, 0, 0}, {0.2f, -0.7f, -1})}) {
    const Emitter emitter = emitter_of(l);
    int outside = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
      const glm::vec3 d = glm::normalize(
          glm::vec3(random_float(3, 1, i, 0), random_float(3, 1, i, 1), random_float(3, 1, i, 2)) - 0.5f);
      const float degrees = glm::degrees(std::acos(glm::clamp(glm::dot(d, l.direction), -1.0f, 1.0f)));
      if (degrees <= emitter.cone_degrees) continue;
      ++outside;
      ASSERT_EQ(emitter.beam->factor(d), glm::vec3(0.0f));
    }
    EXPECT_GT(outside, 5000);
  }
}

}  // namespace
}  // namespace relight
