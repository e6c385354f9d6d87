// The final-gather matrices F_d and F_g in wavelet space (Hasan 2006 section 4.3): hierarchical links from
// view samples to clusters of gather samples, each row transformed to Haar while the tree is walked, so that
// the cost of a row is proportional to its links and no dense row ever exists; then area-weighted selection
// of coefficients.
//
// F_ij = max-clamped  cos(theta_i) cos(theta_j) A_j / (pi r^2) V_ij, so that indirect radiance = k_d * (F g)
// with g the diffuse radiance leaving the gather samples (equation 5, M = 0). cos(theta_i) is taken with the
// shading normal of the view sample, cos(theta_j) with the geometric normal of the gather sample (it converts
// area to solid angle).
//
// F_g,ij = rho_g cos(theta_i) cos(theta_j) A_j / r^2 V_ij has the value of the view sample's glossy lobe
// towards the eye, without its colour (glossy_lobe.h), and one row for each glossy view sample only. Its
// elements come from the same links as F_d's (paper), or from rays that follow the lobe (glossy_rays.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/training_lights.h"

namespace relight::wavelet {
class PictureHaar;
}

namespace relight::direct_to_indirect {

class NearField;
class GlossyRays;

enum class MatrixPart { diffuse, glossy };

struct FinalGatherSettings {
  float link_threshold =
      0.01f;             // subdivide while (cluster diagonal / distance)^2 > this; 0: link every sample
  int link_members = 1;  // random members of its cluster that a link takes the mean over; 0: all of them
  bool mean_elements = false;  // of the members a link takes visibility alone, and the cluster's mean element
  float form_factor_clamp = 0.1f;  // largest element of a link
  bool disc_elements = false;      // links are bounded as discs, cos cos A / (pi r^2 + A), and not clamped
  int coefficients = 100;          // kept a row, or on average a row with shared_budget
  int glossy_coefficients = 100;   // the same of the glossy matrix
  double energy_fraction = 1.0;    // a row keeps no more than it needs for this share of its energy
  bool shared_budget = false;      // all rows share coefficients x rows, the heaviest of all are kept
  float support_exponent =
      1.0f;                  // coefficients are ranked by |c| x support^this: 1 by area (paper), 0 by size
  float refit_ridge = 0.1f;  // see light_refit.h
  float refit_candidates = 1.0f;  // coefficients that the refit chooses from, for each that it keeps
  uint64_t seed = 1;

  // Most that one row may keep. A shared budget is mostly used up below four times the mean.
  size_t row_limit(MatrixPart part) const {
    return static_cast<size_t>(budget(part)) * (shared_budget ? 8 : 1);
  }
  int budget(MatrixPart part) const {
    return part == MatrixPart::diffuse ? coefficients : glossy_coefficients;
  }
};

// That, and how, the glossy matrix is gathered.
struct GlossyGather {
  glm::vec3 eye;                     // of the view
  const GlossyRays* rays = nullptr;  // null: elements come from the links
};

struct FinalGatherInput {
  const RayTracer& tracer;
  const DeepFrameBuffer& buffer;
  const GatherCloud& cloud;  // in tree order
  const GatherHierarchy& hierarchy;
  std::span<const float> column_scale;    // by which columns are divided (column_scaling.h), or empty
  const TrainingLights& training;         // the kept coefficients are refitted to them; none: they are not
  const NearField* near_field = nullptr;  // takes the place of links to near gather samples; or none
  const GlossyGather* glossy = nullptr;   // none: F_d alone
  std::span<const uint8_t> tiles = {};    // by number in ViewTiles: 0 = its rows stay empty; none: all
  const wavelet::PictureHaar* basis = nullptr;  // of the diffuse rows (view_basis.h); none: view samples
};

struct FinalGather {
  // One row a view sample of `buffer`, empty for invalid ones; with a basis one a coefficient, in its order.
  SparseRows diffuse;
  std::vector<uint32_t> glossy_pixels;  // view samples that have a glossy row, ascending
  SparseRows glossy;                    // one row a glossy pixel; nothing at all if there is none
};

// Matrices with one column a wavelet coefficient of the ordered cloud. Logs counters visibility_rays, links,
// coefficients_before_truncation, non_zeros, energy shares; with `glossy` glossy_pixels, and if there are
// any, glossy_coefficients_before_truncation and so on. A view without glossy pixels costs what it does
// without `glossy`, and gives the same bits. Parallel over tiles of 4x4 pixels, whose view samples share
// their links' cut (refined for the closest of them) and random members, so that visibility is tested by
// coherent packets of 16 rays. Deterministic for any number of threads.
FinalGather compute_final_gather(const FinalGatherInput& input, const FinalGatherSettings& settings,
                                 Progress& progress, StageLog& log);

}  // namespace relight::direct_to_indirect
