// The multiple-bounce matrix M (Hasan 2006 sections 3.2, 3.3 and 4.3, "The multiple-bounce matrix"; GPU Gems
// 3 chapter 9): the diffuse radiance that leaves the gather samples after at least one bounce among them, as
// a linear map of the diffuse direct radiance g that leaves them. With rho the albedos and G the gather
// matrix between gather samples (form factors times area ratios, defined like F_d in final_gather.h),
//   M = (rho G) + (rho G)^2 + ... + (rho G)^(bounces - 1),
// so that with the final gather the picture has 1 to `bounces` bounces of indirect light.
//
// Two kinds. `photons`, the paper's: rows of M by density estimation on photons shot from the gather samples
// (multi_bounce_photons.h, multi_bounce_photon_rows.h); one RGB product a relight. `transfer`, ours: rows of
// G by the machinery of the final gather (multi_bounce_transfer.h), applied bounces - 1 times; no photon
// noise or blur, but its links are clamped and truncated again at each bounce.
//
// Column scaling (column_scaling.h) changes the vectors that M acts on to g'_j = w_j g_j: both kinds build
// M' = D_w M D_w^-1.
//
// Does not do: glossy reflection among gather samples, light from the environment or from emitting surfaces.
#pragma once

#include <cstdint>
#include <span>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/sparse_rows_rgb.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "methods/direct_to_indirect/final_gather.h"

namespace relight::direct_to_indirect {

enum class BounceKind { photons, transfer };

struct MultiBounceSettings {
  BounceKind kind = BounceKind::photons;
  int bounces = 1;            // of indirect light in all, that of the final gather included; 1: no M
  int64_t photons = 1000000;  // paths shot, spread evenly over the gather samples: at least one each
  int neighbours = 2000;      // photons of a density estimate
  int coefficients = 40;      // kept a row
  // Of the links of kind `transfer`; its seed and support_exponent hold for both kinds.
  FinalGatherSettings gather;
};

struct MultiBounce {
  int bounces = 1;
  SparseRowsRgb photons;  // M' in wavelet space, one row a gather sample; empty unless of this kind
  SparseRows transfer;    // G D_w^-1 in wavelet space; empty unless of this kind
  // Share of all light leaving the surfaces that has left them after more bounces than are simulated, if
  // every gather sample shone with the same radiance: extrapolated from the last two bounces by a geometric
  // series. 1 if that diverges.
  double share_beyond = 0.0;
};

struct MultiBounceInput {
  const RayTracer& tracer;
  const GatherCloud& cloud;  // in tree order, albedos not yet scaled
  const GatherHierarchy& hierarchy;
  std::span<const float> column_scale;  // w, or empty
};

// settings.bounces > 1. Logs counters bounce_non_zeros, bounce_coefficients_before_truncation and, by kind,
// photons (paths shot), photon_hits and photon_rays, or bounce_visibility_rays. Deterministic for any number
// of threads.
MultiBounce compute_multi_bounce(const MultiBounceInput& input, const MultiBounceSettings& settings,
                                 Progress& progress, StageLog& log);

// The geometric extrapolation of MultiBounce::share_beyond. power[k]: light that left the surfaces after k
// reflections, k = 0 .. bounces - 1, at least two.
double share_beyond(std::span<const double> power);

// Logs the share as counter bounce_energy_beyond_ppm, and warns if it is above 5 %.
void report_share_beyond(const MultiBounce& multi_bounce, StageLog& log);

}  // namespace relight::direct_to_indirect
