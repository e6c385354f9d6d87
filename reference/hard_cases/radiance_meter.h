// Measures radiance at single points with the path tracer, for hard cases and tests against answers found
// without it. The only file of these checks that knows how the path tracer is called.
//
// The error comes from the spread over independent seeds, not from the variance that the path tracer claims:
// a wrong claim can neither hide a bias nor fake one.
#pragma once

#include <cmath>
#include <vector>

#include "reference/path_tracer.h"

namespace relight::check {

// Which light reaches the meter: `first` to `last` bounces of indirect light. Point lights always count; the
// light of emitters and environment with 0 bounces is what they send straight to the surface looked at.
struct Light {
  int first = 1, last = 1;
  bool emission = false, environment = false, glossy = false;
};

// How long to measure. Each seed is one independent run; 20 or more keep Student's t near the normal law.
// Readings that are to be averaged need different first seeds.
struct Effort {
  int samples = 64, seeds = 24;
  Estimator estimator = Estimator::next_event;
  uint64_t first_seed = 1000;
  bool sample_extended_lights = true;  // see PathTracerSettings
};

struct Reading {
  glm::dvec3 mean{0.0}, error{0.0};  // of one channel each; error: standard error of the mean
  int64_t non_finite = 0;
};

// A scene, its lights, and a camera of 4x4 pixels that all look at one point.
class RadianceMeter {
 public:
  RadianceMeter(Scene scene, LightingState lights)
      : scene_(std::move(scene)), lights_(std::move(lights)), tracer_(scene_) {}
  const Scene& scene() const { return scene_; }
  // How far rays start from the surface: it moves what a point sees by that much.
  double ray_offset() const { return static_cast<double>(tracer_.offset()); }

  // Indirect radiance from `target` towards `eye`, averaged over the picture.
  Reading read(const glm::vec3& eye, const glm::vec3& target, const Light& light,
               const Effort& effort) const {
    const glm::vec3 d = glm::abs(glm::normalize(target - eye));
    const glm::vec3 up = d.y < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    // 0.01 degrees: at a distance of 1 the pixels lie within 1e-4 of each other.
    return read({{eye, target, up, 0.01f}, 4, 4}, light, effort);
  }
  // The same, averaged over all pixels of a view.
  Reading read(const View& view, const Light& light, const Effort& effort) const {
    const DeepFrameBuffer buffer = make_deep_frame_buffer(scene_, tracer_, view);
    PathTracerSettings settings;
    settings.paths.min_bounces = light.first, settings.paths.max_bounces = light.last;
    settings.paths.emission = light.emission, settings.paths.environment = light.environment;
    settings.paths.glossy_at_eye = settings.paths.glossy_interior = light.glossy;
    settings.samples_per_pixel = effort.samples, settings.batches = 2;
    settings.estimator = effort.estimator;
    settings.sample_extended_lights = effort.sample_extended_lights;
    Reading reading;
    glm::dvec3 squares(0.0);
    for (int i = 0; i < effort.seeds; ++i) {
      settings.seed = effort.first_seed + static_cast<uint64_t>(i);
      Progress quiet(true);
      StageLog log;
      const PathTracerResult result = path_trace(tracer_, buffer, lights_, settings, quiet, log);
      reading.non_finite += result.non_finite;
      const glm::dvec3 before = mean_of(result.indirect) - reading.mean;
      reading.mean += before / static_cast<double>(i + 1);
      squares += before * (mean_of(result.indirect) - reading.mean);
    }
    reading.error = glm::sqrt(squares / static_cast<double>(effort.seeds * (effort.seeds - 1)));
    return reading;
  }

 private:
  static glm::dvec3 mean_of(const Image& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& p : image.pixels) sum += glm::dvec3(p);
    return sum / static_cast<double>(image.pixels.size());
  }
  Scene scene_;
  LightingState lights_;
  RayTracer tracer_;
};

// Rounding of float sums along a path, relative.
constexpr double rounding = 2e-5;

}  // namespace relight::check
