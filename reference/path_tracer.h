// Monte Carlo reference: an Embree path tracer with next-event estimation, and a second estimator with better
// sampling of light-driven paths; per-pixel mean and variance of the mean by independent batches.
//
// What goes where: `direct` holds point lights seen from the visible surface (0 bounces) and, where
// LightPaths counts them, emission and environment seen by the camera. `indirect` holds
// min_bounces..max_bounces bounces. Environment and emission have no exact direct part: what they send to the
// visible surface (0 bounces) is sampled, and is part of `indirect` if and only if min_bounces = 0.
//
// A lobe that LightPaths doesn't allow at a vertex neither reflects nor is sampled there; `direct` always has
// both lobes.
//
// The light_vertex estimator shares light vertices between the pixels of a 4x4 tile (their errors are
// correlated, different tiles are independent), and from 128 samples a pixel on it traces more paths where a
// separate first look found more noise; see batch_renderer.h.
//
// Does not do: area lights as targets of next-event estimation, refraction, caustics from glossy surfaces
// (found by chance only).
#pragma once

#include <cstdint>

#include "common/image/image.h"
#include "common/run/light_paths.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

enum class Estimator {
  next_event,   // BRDF sampling, next-event estimation at every vertex
  light_vertex  // the same, MIS-combined at every vertex with connections to surfaces first hit by light
};

struct PathTracerSettings {
  LightPaths paths;  // which bounces and lobes count; direct light (0 bounces) is always rendered apart
  // Indirect samples a pixel, spread evenly over the 2x2 sub-pixels of the deep frame buffer; at least
  // `batches`, rounded up to a multiple of it. A multiple of 4 x batches stratifies best.
  int samples_per_pixel = 256;
  int batches = 8;  // independent scramblings; variance comes from their spread. >= 2
  Estimator estimator = Estimator::light_vertex;
  uint64_t seed = 1;
  // > 0: stop before the batch that would exceed it; whole batches, direct light included; at least two
  // batches (with one_sequence: one).
  double time_limit_s = 0.0;
  // Batches continue one Sobol sequence: less noise under a time limit, but no variance.
  bool one_sequence = false;
};

struct PathTracerResult {
  Image direct;             // exact: traced shadows at the 2x2 sub-pixels, box-filtered; full BRDF
  Image indirect;           // mean
  Image indirect_variance;  // variance of the mean, per channel; empty with one_sequence
  int samples_per_pixel = 0, batches = 0;  // actually done
  int64_t rays = 0;
  int64_t non_finite = 0;  // samples replaced by zero; > 0 is a failure to report
  Image total() const;
};

// Logs stages "direct" and "indirect". Same bits for any number of threads (unless a time limit ends it).
// Throws Error for settings out of range.
PathTracerResult path_trace(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                            const LightingState& lighting, const PathTracerSettings& settings,
                            Progress& progress, StageLog& log);

}  // namespace relight
