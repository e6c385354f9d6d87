// Renders tiny scenes with the path tracer, and the statistics its tests share.
#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "reference/path_tracer.h"
#include "tests/support/tiny_scenes.h"

namespace relight::tiny {

// A scene with everything a path tracer needs to start.
struct Rendering {
  Scene scene;
  RayTracer tracer;
  DeepFrameBuffer buffer;
  Rendering(Scene s, int width, int height)
      : scene(std::move(s)),
        tracer(scene),
        buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})) {}
  PathTracerResult operator()(const LightingState& lights, const PathTracerSettings& settings) const {
    Progress quiet(true);
    StageLog log;
    return path_trace(tracer, buffer, lights, settings, quiet, log);
  }
};

inline PathTracerSettings settings(Estimator estimator, int samples, int batches, LightPaths paths = {},
                                   uint64_t seed = 1) {
  PathTracerSettings s;
  s.estimator = estimator, s.samples_per_pixel = samples, s.batches = batches, s.paths = paths, s.seed = seed;
  return s;
}

inline LightPaths bounces(int min, int max, bool glossy = false) {
  LightPaths paths;
  paths.min_bounces = min, paths.max_bounces = max;
  paths.glossy_at_eye = paths.glossy_interior = glossy;
  return paths;
}

inline glm::dvec3 mean_of(const Image& image) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& p : image.pixels) sum += glm::dvec3(p);
  return sum / static_cast<double>(image.pixels.size());
}

// Are two images with given variances samples of the same mean? Pixels and batches are independent, so that
// under the hypothesis each z is about standard normal (a little wider: the variances are estimates from some
// 60 batches).
struct ZTest {
  double largest = 0, mean_square = 0, of_the_mean = 0;
  ZTest(const Image& a, const Image& var_a, const Image& b, const Image& var_b) {
    double difference = 0, variance = 0;
    int count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
        const double v = static_cast<double>(var_a.pixels[i][c]) + static_cast<double>(var_b.pixels[i][c]);
        if (d == 0.0) continue;
        difference += d, variance += v, ++count;
        largest = std::max(largest, std::abs(d) / std::sqrt(v));
        mean_square += d * d / v;
      }
    mean_square /= std::max(count, 1);
    // The three channels of a pixel share their paths: 3 x variance is the most that correlation can make of
    // it.
    of_the_mean = count ? difference / std::sqrt(3.0 * variance) : 0.0;
  }
};

// 6.5 standard errors: with up to 4000 values of 60 degrees of freedom a false alarm has probability below
// 1e-4.
inline void expect_same_mean(const ZTest& z) {
  EXPECT_LT(z.largest, 6.5);
  EXPECT_LT(std::abs(z.of_the_mean), 4.0);
  EXPECT_LT(z.mean_square, 1.35);
}

}  // namespace relight::tiny
