// Exact direct light of a view, for the reference: no GPU code involved.
#pragma once

#include "common/image/image.h"
#include "common/run/light_paths.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "reference/light_sampler.h"

namespace relight {

struct DirectImage {
  Image image;
  int64_t rays = 0;
  int64_t non_finite = 0;  // sub-samples replaced by zero
};

// Radiance from point lights by traced shadow rays at the 2x2 sub-samples (full BRDF), plus emission and
// environment seen by the camera where `paths` counts them; box-filtered. Parallel over rows, deterministic.
DirectImage trace_direct(const RayTracer& tracer, const DeepFrameBuffer& buffer, const LightSampler& lights,
                         const LightPaths& paths);

}  // namespace relight
