// Sums of final-gather rows against analytic form factors (Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors): from a differential element to a parallel rectangle (B-3), a perpendicular
// rectangle (B-4) and a coaxial parallel disc (B-12).
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/wavelet/haar.h"
#include "tests/direct_to_indirect/gather_setup.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int64_t samples = 16384;

// Sum of row 0 = scaling coefficient x sqrt(columns): the form factor from the view sample to everything it
// sees.
double row_sum(Scene scene, const SurfaceSample& element) {
  finish_scene(scene);
  GatherSetup s(std::move(scene), 4, 4, samples, true);
  s.buffer.indirect.assign(16, SurfaceSample{});
  s.buffer.indirect[0] = element;
  const SparseRows rows = s.final_gather(exact_settings(samples));
  return dense_row(rows, 0)[0] * std::sqrt(static_cast<double>(samples));
}

SurfaceSample element(const glm::vec3& position, const glm::vec3& normal) {
  SurfaceSample s;
  s.position = position, s.shading_normal = s.geometric_normal = normal, s.valid = true;
  return s;
}

// Half of the samples lie on the back of the target, so 8192 points integrate a smooth function: error well
// below 1 %.
constexpr double tolerance = 2e-3;

// Red if cos/(pi r^2) loses a factor, or areas are not split between the sides.
TEST(FormFactor, OfAParallelRectangleAboveItsCorner) {
  for (const double h : {0.5, 1.0, 3.0}) {
    const double a = 2.0 / h, b = 1.0 / h;
    const double expected = (a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a)) +
                             b / std::sqrt(1 + b * b) * std::atan(a / std::sqrt(1 + b * b))) /
                            (2 * pi);
    Scene scene = tiny::empty_scene();
    tiny::add_quad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, 1});
    EXPECT_NEAR(row_sum(scene, element({0, static_cast<float>(h), 0}, {0, -1, 0})), expected,
                tolerance * expected)
        << h;
  }
}

// Red if one of the two cosines uses the wrong normal: for this pair they differ.
TEST(FormFactor, OfAPerpendicularRectangle) {
  for (const double c : {0.5, 1.0}) {  // distance of the element from the rectangle's plane
    const double width = 2.0, height = 1.5;
    const double x = height / width, y = c / width;
    const double expected =
        (std::atan(1.0 / y) - y / std::sqrt(x * x + y * y) * std::atan(1.0 / std::sqrt(x * x + y * y))) /
        (2 * pi);
    Scene scene = tiny::empty_scene();
    tiny::add_quad(scene, {0, 0, 0}, {2, 0, 0}, {0, 1.5f, 0});  // in the plane z = 0
    EXPECT_NEAR(row_sum(scene, element({0, 0, static_cast<float>(c)}, {0, 1, 0})), expected,
                tolerance * expected)
        << c;
  }
}

// Red if the samples in a fan of slivers are not spread by area.
TEST(FormFactor, OfACoaxialDisc) {
  const float radius = 1.0f;
  const int n = 512;  // the polygon's area falls short of the disc's by 2.5e-5
  Scene scene = tiny::empty_scene();
  const uint32_t centre = tiny::add_vertex(scene, {0, 0, 0}, {0, 1, 0});
  for (int i = 0; i <= n; ++i) {
    const double phi = 2 * pi * i / n;
    tiny::add_vertex(scene, {radius * std::cos(phi), 0, radius * std::sin(phi)}, {0, 1, 0});
  }
  for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i)
    tiny::add_triangle(scene, centre, centre + i + 2, centre + i + 1);
  for (const double h : {0.7, 2.0}) {
    const double expected = 1.0 / (1.0 + h * h);
    EXPECT_NEAR(row_sum(scene, element({0, static_cast<float>(h), 0}, {0, -1, 0})), expected,
                tolerance * expected)
        << h;
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
