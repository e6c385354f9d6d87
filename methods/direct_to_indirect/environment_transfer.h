// The matrices that carry light of the environment (Hasan 2006 section 6, "environment samples"): to view
// samples, diffuse F_e and glossy F_e,g, and to gather samples, G_e. Columns are Haar coefficients of the
// environment square (common/sampling/environment_samples.h), rows are truncated like those of the final
// gather. With L the radiances of the square's texels,
//
//   direct light     v_i = k_d (F_e^w W L)_i + k_g (F_e,g^w W L)_i
//   indirect light   g <- g + rho * (G_e^w W L)    before g goes through M and F (equation 7).
//
// A constant environment has one coefficient, the mean, which every row keeps: truncation costs nothing
// there.
#pragma once

#include <cstdint>
#include <span>

#include "common/linalg/sparse_rows.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"

namespace relight::direct_to_indirect {

struct EnvironmentSettings {
  int64_t samples = 4096;         // texels of the square
  int coefficients = 100;         // kept a row of F_e and of F_e,g
  int gather_coefficients = 40;   // kept a row of G_e
  float support_exponent = 1.0f;  // coefficients are ranked by |c| x support^this
  int glossy_rays = 256;          // of each glossy view sample; 0: no glossy matrix
  uint64_t seed = 1;
};

struct EnvironmentTransfer {
  SparseRows view;    // one row a view sample of the buffer, empty for invalid ones
  SparseRows glossy;  // one row a glossy pixel; nothing at all if there is none, or none is asked for
  SparseRows gather;  // one row a gather sample
  bool empty() const { return view.rows() == 0; }
  int64_t bytes() const { return view.bytes() + glossy.bytes() + gather.bytes(); }
};

struct EnvironmentInput {
  const RayTracer& tracer;
  const DeepFrameBuffer& buffer;
  const GatherCloud& cloud;
  std::span<const uint8_t> tiles = {};  // by number in ViewTiles: 0 = its rows stay empty; none: all
};

// Logs counters environment_rays, environment_coefficients_before_truncation and environment_non_zeros.
// Parallel, deterministic for any number of threads.
EnvironmentTransfer compute_environment_transfer(const EnvironmentInput& input,
                                                 const EnvironmentSettings& settings, Progress& progress,
                                                 StageLog& log);

}  // namespace relight::direct_to_indirect
