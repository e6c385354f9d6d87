// One bounce between two parallel rectangles against quadrature in double.
#include <cmath>

#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

constexpr double albedo_floor = 0.8, albedo_ceiling = 0.5, glossy_floor = 0.3, exponent = 8.0;
const glm::dvec3 light_position(0.2, 0.1, 0.7);

// Floor [-1,1]^2 at z = 0 and ceiling at z = 1, seen from between them.
Rendering two_plates() {
  Scene scene = empty_scene(glm::vec3(static_cast<float>(albedo_floor)));
  scene.materials[0].glossy = glm::vec3(static_cast<float>(glossy_floor));
  scene.materials[0].exponent = static_cast<float>(exponent);
  Material ceiling;
  ceiling.diffuse = glm::vec3(static_cast<float>(albedo_ceiling));
  const uint32_t above = add_material(scene, ceiling);
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  add_quad(scene, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, above);
  scene.camera = {{0.1f, -0.9f, 0.1f}, {0.0f, 0.1f, 1.0f}, {0, 0, 1}, 20.0f};
  finish_scene(scene);
  return Rendering(std::move(scene), 6, 4);
}

// Radiance leaving the ceiling at x by one bounce off the floor: midpoint rule over the floor.
double quadrature(const glm::dvec3& x, bool glossy) {
  const int n = 300;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 y(-1.0 + 2.0 * (i + 0.5) / n, -1.0 + 2.0 * (j + 0.5) / n, 0.0);
      const glm::dvec3 to_light = light_position - y, to_x = x - y;
      const double r2 = glm::dot(to_light, to_light), d2 = glm::dot(to_x, to_x);
      const glm::dvec3 wl = to_light / std::sqrt(r2), wx = to_x / std::sqrt(d2);
      double brdf = albedo_floor / M_PI;
      const double lobe = -wl.x * wx.x - wl.y * wx.y + wl.z * wx.z;
      if (glossy && lobe > 0.0)
        brdf += glossy_floor * (exponent + 2.0) / (2.0 * M_PI) * std::pow(lobe, exponent);
      sum += brdf * (wl.z / r2) * wx.z * wx.z / d2;
    }
  return albedo_ceiling / M_PI * sum * 4.0 / (n * n);
}

// Exact up to quadrature: 0 variance.
Image oracle(const Rendering& render, bool glossy) {
  Image image(render.buffer.view.width, render.buffer.view.height);
  for (int y = 0; y < 2 * image.height; ++y)
    for (int x = 0; x < 2 * image.width; ++x) {
      const SurfaceSample& s = render.buffer.direct[static_cast<size_t>(y * 2 * image.width + x)];
      EXPECT_NEAR(s.position.z, 1.0f, 1e-5f) << "the view must show the ceiling only";
      image.at(x / 2, y / 2) += glm::vec3(0.25 * quadrature(glm::dvec3(s.position), glossy));
    }
  return image;
}

// Red if (each tried): pi or an albedo is lost in a connection, the cosine where the BRDF reflects, r^2 in
// the density of a light vertex, or all samples go to one sub-pixel.
TEST(ParallelRectangles, OneBounceEqualsQuadrature) {
  const Rendering render = two_plates();
  const LightingState lights = lighting({omni(glm::vec3(light_position))});
  const Image zero(6, 4);
  for (bool glossy : {false, true}) {
    LightPaths paths = bounces(1, 1);
    paths.glossy_interior = glossy;
    const Image expected = oracle(render, glossy);
    for (Estimator estimator : {Estimator::next_event, Estimator::light_vertex}) {
      const PathTracerResult result = render(lights, settings(estimator, 64 * 256, 64, paths));
      expect_same_mean(ZTest(result.indirect, result.indirect_variance, expected, zero));
      EXPECT_LT(mean_of(result.indirect_variance).x, std::pow(0.01 * mean_of(expected).x, 2))
          << "too noisy to tell";
    }
  }
}

// Red if: direct light lacks a factor (tried: 1/r for 1/r^2). The ceiling sees the light at 0.3 below.
TEST(ParallelRectangles, DirectLightIsTheInverseSquareLaw) {
  const Rendering render = two_plates();
  const PathTracerResult result =
      render(lighting({omni(glm::vec3(light_position))}), settings(Estimator::next_event, 2, 2));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) {
      double expected = 0;
      for (int s = 0; s < 4; ++s) {
        const glm::dvec3 p(
            render.buffer.direct[static_cast<size_t>((2 * y + s / 2) * 12 + 2 * x + s % 2)].position);
        const glm::dvec3 to_light = light_position - p;
        const double r2 = glm::dot(to_light, to_light);
        expected += 0.25 * albedo_ceiling / M_PI * 0.3 / std::pow(r2, 1.5);
      }
      EXPECT_NEAR(result.direct.at(x, y).x, expected, 1e-5 * expected);
    }
}

}  // namespace
}  // namespace relight::tiny
