// Exact direct light of a view, for the reference: no GPU code involved.
#pragma once

#include "common/image/image.h"
#include "common/run/light_paths.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "reference/area_lights.h"
#include "reference/environment_sampler.h"
#include "reference/light_sampler.h"
#include "reference/path_classes.h"

namespace relight {

struct DirectImage {
  // Delta lights by the lobe that reflects them; emission and environment that the camera sees.
  Image local_diffuse, local_glossy, seen_area, seen_environment;
  // Rectangles and discs, if they were asked for: estimates, with the variance of their sum.
  Image area_diffuse, area_glossy, area_variance;
  // The same of the environment as the visible surface reflects it.
  Image environment_diffuse, environment_glossy, environment_variance;
  Image total() const;
  // The classes of the first four images, in the order above; of the light of rectangles and discs, and of
  // the environment.
  static std::vector<PathClass> classes();
  static std::vector<PathClass> area_classes();
  static std::vector<PathClass> environment_classes();
  bool has_area() const { return !area_diffuse.pixels.empty(); }
  bool has_environment() const { return !environment_diffuse.pixels.empty(); }
  int64_t rays = 0;
  int64_t non_finite = 0;  // sub-samples replaced by zero
};

// What trace_direct estimates besides; `points` (even, >= 2) scrambled points for each sub-sample and light.
struct DirectEstimates {
  const AreaLights* area = nullptr;                 // rectangles and discs; null: none
  const EnvironmentSampler* environment = nullptr;  // light that surfaces reflect; null: none
  int points = 0;
  uint64_t seed = 0;
};

// Radiance from delta lights by traced shadow rays at the 2x2 sub-samples (full BRDF), plus emission and
// environment seen by the camera where `paths` counts them; box-filtered. Parallel over rows, deterministic.
// The environment's light is reflected by the lobes that `paths` allows at the eye.
DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const Environment& environment, const LightPaths& paths,
                         const DirectEstimates& estimates = {});

}  // namespace relight
