// The diffuse final-gather matrix F_d in wavelet space (Hasan 2006 section 4.3): hierarchical links from view
// samples to clusters of gather samples, each row transformed to Haar while the tree is walked, so that the
// cost of a row is proportional to its links and no dense row ever exists; then area-weighted selection of
// coefficients.
//
// F_ij = max-clamped  cos(theta_i) cos(theta_j) A_j / (pi r^2) V_ij, so that indirect radiance = k_d * (F g)
// with g the diffuse radiance leaving the gather samples (equation 5, M = 0). cos(theta_i) is taken with the
// shading normal of the view sample, cos(theta_j) with the geometric normal of the gather sample (it converts
// area to solid angle).
//
// Does not do: the glossy matrix.
#pragma once

#include <cstdint>
#include <span>

#include "common/linalg/sparse_rows.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/training_lights.h"

namespace relight::direct_to_indirect {

class NearField;

struct FinalGatherSettings {
  float link_threshold =
      0.01f;                 // subdivide while (cluster diagonal / distance)^2 > this; 0: link every sample
  bool all_members = false;  // a link takes the mean over its cluster's members instead of one of them
  float form_factor_clamp = 0.1f;  // largest element of a link
  bool disc_elements = false;      // links are bounded as discs, cos cos A / (pi r^2 + A), and not clamped
  int coefficients = 100;          // kept a row, or on average a row with shared_budget
  double energy_fraction = 1.0;    // a row keeps no more than it needs for this share of its energy
  bool shared_budget = false;      // all rows share coefficients x rows, the heaviest of all are kept
  float support_exponent =
      1.0f;                  // coefficients are ranked by |c| x support^this: 1 by area (paper), 0 by size
  float refit_ridge = 0.1f;  // see light_refit.h
  float refit_candidates = 1.0f;  // coefficients that the refit chooses from, for each that it keeps
  uint64_t seed = 1;

  // Most that one row may keep. A shared budget is mostly used up below four times the mean.
  size_t row_limit() const { return static_cast<size_t>(coefficients) * (shared_budget ? 8 : 1); }
};

struct FinalGatherInput {
  const RayTracer& tracer;
  const DeepFrameBuffer& buffer;
  const GatherCloud& cloud;  // in tree order
  const GatherHierarchy& hierarchy;
  std::span<const float> column_scale;    // by which columns are divided (column_scaling.h), or empty
  const TrainingLights& training;         // the kept coefficients are refitted to them; none: they are not
  const NearField* near_field = nullptr;  // takes the place of links to near gather samples; or none
  std::span<const uint8_t> tiles = {};    // by number in ViewTiles: 0 = its rows stay empty; none: all
};

// One row a view sample of `buffer` (empty for invalid ones), one column a wavelet coefficient of the ordered
// cloud. Logs counters visibility_rays, links, coefficients_before_truncation, non_zeros, energy shares.
// Parallel over tiles of 4x4 pixels, whose view samples share their links' cut (refined for the closest of
// them) and random members, so that visibility is tested by coherent packets of 16 rays. Deterministic for
// any number of threads.
SparseRows compute_final_gather(const FinalGatherInput& input, const FinalGatherSettings& settings,
                                Progress& progress, StageLog& log);

}  // namespace relight::direct_to_indirect
