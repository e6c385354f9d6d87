// Rows of the multiple-bounce matrix by density estimation (Hasan 2006 section 4.3): the nearest photons of a
// gather sample are a sparse approximation of its row.
//
//   M_ij = rho_i / (pi r^2) x sum of Photon::area over the photons of source j within r of sample i
//
// with r the distance of the K-th nearest photon, which itself is left out (the estimate of a constant
// density is then unbiased). All photons count for K, but only those whose normal is within 60 degrees of the
// sample's add to the sum: what hit the other side, or the other wall of a corner, does not light this
// sample. The disc is not cut where the surface ends, as in the paper: rows of samples within r of an edge
// are too dark, and light is blurred over r. Parallel surfaces closer than r, one above the other, are not
// told apart.
//
// Each row is transformed to Haar at a cost proportional to its photons, and keeps the coefficients with the
// largest |c| x support^support_exponent, |c| the length of the RGB vector.
#pragma once

#include "methods/direct_to_indirect/multi_bounce.h"
#include "methods/direct_to_indirect/multi_bounce_photons.h"

namespace relight::direct_to_indirect {

// M' of multi_bounce.h in wavelet space, one row a gather sample. Logs counters
// bounce_coefficients_before_truncation and photon_discs_empty: samples with no radius, because all photons
// that they found are at one place or there is but one (their rows are empty). Parallel over samples.
SparseRowsRgb photon_rows(const MultiBounceInput& input, const PhotonMap& map,
                          const MultiBounceSettings& settings, Progress& progress, StageLog& log);

}  // namespace relight::direct_to_indirect
