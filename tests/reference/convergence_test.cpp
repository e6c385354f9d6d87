// Stopping at an error or a time, the error over time, and fireflies.
#include "common/run/error.h"
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

const LightingState lamp = lighting({omni({0.3f, 0.6f, 0.4f})});

double relative_error(const PathTracerResult& result) {
  double error = 0.0, sum = 0.0;
  const Image total = result.total();
  for (size_t i = 0; i < total.pixels.size(); ++i) {
    const glm::dvec3 v(result.indirect_variance.pixels[i]), m(total.pixels[i]);
    error += v.x + v.y + v.z;
    sum += glm::dot(m, m);
  }
  return std::sqrt(error / sum);
}

// Red if (each tried): direct light is left out of the norm, variance is that of one batch, or the square
// root is forgotten.
TEST(Convergence, StatesTheStandardErrorRelativeToTheWholePicture) {
  const Rendering render(room(), 16, 12);
  const PathTracerResult result = render(lamp, settings(Estimator::next_event, 64, 8));
  EXPECT_NEAR(result.relative_standard_error / relative_error(result), 1.0, 1e-5);
}

// Red if (both tried): the run goes on after the target, or stops before the fourth batch.
TEST(Convergence, StopsAtTheTargetErrorAndNotBefore) {
  const Rendering render(room(), 16, 12);
  PathTracerSettings s = settings(Estimator::next_event, 16 * 1000, 1000);
  s.target_error = 0.01;
  std::vector<ConvergencePoint> points;
  s.on_batch = [&](const ConvergencePoint& p) { points.push_back(p); };
  const PathTracerResult result = render(lamp, s);
  EXPECT_LE(result.relative_standard_error, 0.01);
  EXPECT_GE(result.relative_standard_error, 0.005) << "stopped much too late";
  EXPECT_NEAR(relative_error(result), result.relative_standard_error, 1e-6);
  EXPECT_GT(result.batches, 4);
  EXPECT_LT(result.batches, 1000);
  ASSERT_EQ(points.size(), static_cast<size_t>(result.batches));
  for (size_t i = 3; i + 1 < points.size(); ++i) EXPECT_GT(points[i].relative_standard_error, 0.01) << i;
  s.target_error = 10.0;
  EXPECT_EQ(render(lamp, s).batches, 4) << "at least four batches, however low the bar";
  s.target_error = -1.0;
  EXPECT_THROW(render(lamp, s), Error);
}

// Over 64 times the batches the error falls by 8; it is an estimate from 4 batches and more, pooled over 192
// pixels, within 15 %. Red if (each tried): the callback lacks a batch, counts samples wrongly, or gets the
// error of the batch before.
TEST(Convergence, ErrorFallsWithTheSquareRootOfTheSamples) {
  const Rendering render(room(), 16, 12);
  PathTracerSettings s = settings(Estimator::next_event, 4 * 256, 256);
  std::vector<ConvergencePoint> points;
  s.on_batch = [&](const ConvergencePoint& p) { points.push_back(p); };
  const PathTracerResult result = render(lamp, s);
  ASSERT_EQ(points.size(), 256u);
  EXPECT_EQ(points[0].relative_standard_error, 0.0) << "one batch says nothing";
  for (size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(points[i].samples_per_pixel, 4 * (static_cast<int>(i) + 1));
    EXPECT_GE(points[i].seconds, points[i > 0 ? i - 1 : 0].seconds);
  }
  EXPECT_EQ(points.back().relative_standard_error, result.relative_standard_error);
  for (const size_t n : {16u, 64u, 256u})
    EXPECT_NEAR(points[n - 1].relative_standard_error / result.relative_standard_error, std::sqrt(256.0 / n),
                0.15 * std::sqrt(256.0 / n));
}

// Whole batches within the limit; two are always made. Red if (tried): the limit is forgotten once a target
// is set.
TEST(Convergence, TimeLimitEndsARunThatMissesItsTarget) {
  const Rendering render(room(), 16, 12);
  PathTracerSettings s = settings(Estimator::next_event, 1 << 20, 1 << 18);
  s.target_error = 1e-9, s.time_limit_s = 0.2;
  const PathTracerResult result = render(lamp, s);
  EXPECT_LT(result.seconds, 1.0);
  EXPECT_LT(result.batches, 1 << 18);
  EXPECT_GT(result.relative_standard_error, 1e-9);
}

// A plate, and a tiny lamp of great power that only BRDF rays can find: about one path in 4000 meets it. Red
// if (both tried): the brightest batch is not kept, or the count is left out of the result.
TEST(Convergence, CountsPixelsThatOneRareBrightPathDominates) {
  Scene scene = empty_scene(glm::vec3(0.5f));
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  Material lamp_material;
  lamp_material.diffuse = glm::vec3(0.0f);
  lamp_material.emission = glm::vec3(1e5f);
  add_quad(scene, {-0.01f, 1.0f, -0.01f}, {0.03f, 0, 0}, {0, 0, 0.03f}, add_material(scene, lamp_material));
  scene.camera = {{0.1f, 0.5f, 0.8f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 20.0f};
  finish_scene(scene);
  const Rendering render(std::move(scene), 16, 12);
  LightPaths paths = bounces(0, 0);
  paths.emission = true;
  PathTracerSettings s = settings(Estimator::next_event, 16 * 16, 16, paths);
  s.sample_extended_lights = false;
  const PathTracerResult rare = render({}, s);
  int dominated = 0;
  for (size_t i = 0; i < rare.indirect.pixels.size(); ++i) {
    const double mean = static_cast<double>(rare.indirect.pixels[i].x);
    const double error = std::sqrt(static_cast<double>(rare.indirect_variance.pixels[i].x));
    dominated += mean > 0.0 && error > 0.99 * mean;  // one batch of 16 has all: then they are equal
  }
  EXPECT_GT(dominated, 5);
  EXPECT_GE(rare.fireflies, dominated);
  EXPECT_LT(rare.fireflies, 100);
  s.sample_extended_lights = true;
  EXPECT_EQ(render({}, s).fireflies, 0);
}

// Red if (both tried): pixels without light, or with few batches, count as fireflies.
TEST(Convergence, FindsNoFirefliesInACleanScene) {
  const Rendering render(room(), 16, 12);
  EXPECT_EQ(render(lamp, settings(Estimator::light_vertex, 64, 8)).fireflies, 0);
  EXPECT_EQ(render({}, settings(Estimator::light_vertex, 64, 8)).fireflies, 0);
  EXPECT_EQ(render(lamp, settings(Estimator::next_event, 2, 2)).fireflies, 0);
}

}  // namespace
}  // namespace relight::tiny
