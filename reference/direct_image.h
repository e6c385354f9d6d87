// Exact direct light of a view, for the reference: no GPU code involved.
#pragma once

#include "common/image/image.h"
#include "common/run/light_paths.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "reference/area_lights.h"
#include "reference/light_sampler.h"
#include "reference/path_classes.h"

namespace relight {

struct DirectImage {
  // Delta lights by the lobe that reflects them; emission and environment that the camera sees.
  Image local_diffuse, local_glossy, seen_area, seen_environment;
  // Rectangles and discs, if they were asked for: estimates, with the variance of their sum.
  Image area_diffuse, area_glossy, area_variance;
  Image total() const;
  // The classes of the first four images, in the order above, and of the light of rectangles and discs.
  static std::vector<PathClass> classes();
  static std::vector<PathClass> area_classes();
  bool has_area() const { return !area_diffuse.pixels.empty(); }
  int64_t rays = 0;
  int64_t non_finite = 0;  // sub-samples replaced by zero
};

// Radiance from delta lights by traced shadow rays at the 2x2 sub-samples (full BRDF), plus emission and
// environment seen by the camera where `paths` counts them; box-filtered. Parallel over rows, deterministic.
// area: rectangles and discs to be added, by area_samples scrambled points (even, >= 2) a light and
// sub-sample; null: none.
DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const Environment& environment, const LightPaths& paths,
                         const AreaLights* area = nullptr, int area_samples = 0, uint64_t seed = 0);

}  // namespace relight
