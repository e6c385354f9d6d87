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

// Are two images with given variances samples of the same mean? Under the hypothesis each z is about standard
// normal, a little wider because variances are estimates from some 60 batches. Needs pixels whose samples
// aren't rare events.
struct ZTest {
  double largest = 0, mean_square = 0;
  ZTest(const Image& a, const Image& var_a, const Image& b, const Image& var_b) {
    int count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
        const double v = static_cast<double>(var_a.pixels[i][c]) + static_cast<double>(var_b.pixels[i][c]);
        if (d == 0.0) continue;
        ++count;
        largest = std::max(largest, std::abs(d) / std::sqrt(v));
        mean_square += d * d / v;
      }
    mean_square /= std::max(count, 1);
  }
};

// 6.5 standard errors: with up to 4000 values of 60 degrees of freedom a false alarm has probability below
// 1e-4.
inline void expect_same_mean(const ZTest& z) {
  EXPECT_LT(z.largest, 6.5);
  EXPECT_LT(z.mean_square, 1.35);
}

// Mean of a picture and its standard error by independent seeds: pixels of one picture may be correlated.
struct PictureMean {
  double mean = 0, error = 0;
  PictureMean(const Rendering& render, const LightingState& lights, PathTracerSettings settings, int seeds) {
    double squares = 0;
    for (int i = 0; i < seeds; ++i) {
      settings.seed = settings.seed * 1000 + static_cast<uint64_t>(i);
      const glm::dvec3 m = mean_of(render(lights, settings).indirect);
      const double value = (m.x + m.y + m.z) / 3.0, before = value - mean;
      mean += before / (i + 1);
      squares += before * (value - mean);
    }
    error = std::sqrt(squares / (seeds - 1) / seeds);
  }
};

}  // namespace relight::tiny
