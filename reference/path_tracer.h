// Monte Carlo reference: an Embree path tracer with next-event estimation, and a second estimator with better
// sampling of light-driven paths; per-pixel mean and variance of the mean by independent batches.
//
// What goes where: `direct` holds delta lights (omni, spot, directional) seen from the visible surface (0
// bounces) and, where LightPaths counts them, emission and environment seen by the camera. `indirect` holds
// min_bounces..max_bounces bounces. Lights with an area and the environment have no exact direct part: what
// they send to the visible surface (0 bounces) is sampled, and is part of `indirect` if min_bounces = 0. If
// not, `direct` holds that of rectangles, discs and the environment, by area_samples points, its variance
// counted in indirect_variance; that of emitting surfaces is left out. Light from the environment has bounces
// up to LightPaths::last_environment_bounce().
//
// A lobe that LightPaths doesn't allow at a vertex neither reflects nor is sampled there; `direct` always has
// both lobes.
//
// The light_vertex estimator shares light vertices between the pixels of a 4x4 tile (their errors are
// correlated, different tiles are independent), and from 128 samples a pixel on it traces more paths where a
// separate first look found more noise; see batch_renderer.h.
//
// Does not do: refraction, caustics from glossy surfaces (found by chance only).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/run/light_paths.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "reference/path_classes.h"

namespace relight {

enum class Estimator {
  next_event,   // BRDF sampling, next-event estimation at every vertex
  light_vertex  // the same, MIS-combined at every vertex with connections to surfaces first hit by light
};

// The error of the picture so far.
struct ConvergencePoint {
  double seconds = 0.0;  // of rendering, all sessions together
  int samples_per_pixel = 0;
  double relative_standard_error = 0.0;  // |standard error of the mean|_2 / |total|_2 over all pixels, HDR
};

struct Checkpoint {
  std::filesystem::path file;  // empty: none
  std::string key;             // what it belongs to, in words; see load_state()
  double every_s = 30.0;       // written at least at the end, and after batches that end this much later
};

struct PathTracerSettings {
  LightPaths paths;  // which bounces and lobes count; direct light (0 bounces) is always rendered apart
  // Indirect samples a pixel, spread evenly over the 2x2 sub-pixels of the deep frame buffer; at least
  // `batches`, rounded up to a multiple of it. A multiple of 4 x batches stratifies best.
  int samples_per_pixel = 256;
  int batches = 8;  // independent scramblings; variance comes from their spread. >= 2
  Estimator estimator = Estimator::light_vertex;
  uint64_t seed = 1;
  // False: lights with an area and the environment are found by BRDF rays only. Unbiased too, so a check of
  // their sampling; in a closed room of even emission it has no noise at all.
  bool sample_extended_lights = true;
  // With min_bounces >= 1: points on each rectangle or disc, and of the environment, that its direct light is
  // estimated by, for each of the 2x2 sub-samples; even, >= 2.
  int area_samples = 64;
  // > 0: stop before the batch that would exceed it; whole batches, direct light included; at least two
  // batches (with one_sequence: one).
  double time_limit_s = 0.0;
  // Batches continue one Sobol sequence: less noise under a time limit, but no variance.
  bool one_sequence = false;
  // >= 0: tell path classes apart, by bounce counts up to this and one class for more.
  int class_bounces = -1;
  // A pattern (path_pattern.h) of the classes that make up `direct` and `indirect`; empty: all. Needs
  // class_bounces >= 0. Layers hold all classes all the same.
  std::string pattern;
  // > 0: stop as soon as the relative standard error is at or below it, after at least 4 batches.
  double target_error = 0.0;
  Checkpoint checkpoint;                                  // resumed from, if there is one
  std::function<void(const ConvergencePoint&)> on_batch;  // called after each batch, on the caller's thread
};

// Mean and variance of one path class; variance zero where light is exact.
struct PathLayer {
  PathClass path_class;
  Image mean, variance;
};

struct PathTracerResult {
  // Traced shadows at the 2x2 sub-pixels, box-filtered; full BRDF. Exact but for rectangles and discs.
  Image direct;
  Image indirect;           // mean
  Image indirect_variance;  // variance of the mean of direct + indirect, per channel; empty with one_sequence
  int samples_per_pixel = 0, batches = 0;  // actually done
  int64_t rays = 0;
  int64_t non_finite = 0;                // samples replaced by zero; > 0 is a failure to report
  int64_t fireflies = 0;                 // pixels that one batch dominates (PixelStatistics::is_firefly)
  double seconds = 0.0;                  // of rendering, all sessions together
  double relative_standard_error = 0.0;  // see ConvergencePoint; 0 with one_sequence
  std::vector<PathLayer> layers;         // with class_bounces >= 0; the sum of those that count is total()
  Image total() const;
};

// Logs stages "direct" and "indirect". Same bits for any number of threads (unless a time limit ends it).
// Throws Error for settings out of range.
PathTracerResult path_trace(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                            const LightingState& lighting, const PathTracerSettings& settings,
                            Progress& progress, StageLog& log);

}  // namespace relight
