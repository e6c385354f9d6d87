// The gather matrix between gather samples, by the hierarchical links of the final gather: an alternative to
// photons for the multiple-bounce matrix. Not in the paper, which shoots photons (section 4.3) because a row
// then costs less than links do; Hanrahan et al. 1991 is what iterates links.
//
// Rows are those of F_d (final_gather.h) with a gather sample in the place of the view sample: 16 samples
// that follow each other in tree order form a tile. One bounce is  h -> rho * (G^w W h).
#pragma once

#include <vector>

#include "methods/direct_to_indirect/multi_bounce.h"

namespace relight::direct_to_indirect {

// G D_w^-1 in wavelet space, each row cut to settings.coefficients. Logs counters bounce_visibility_rays,
// bounce_links and bounce_coefficients_before_truncation. Parallel over tiles.
SparseRows transfer_rows(const MultiBounceInput& input, const MultiBounceSettings& settings,
                         Progress& progress, StageLog& log);

// Light leaving the gather samples after 0 .. bounces - 1 bounces among them, luminance of sum A_i h_i with
// h = 1 at first: PhotonMap::power by the rows of transfer_rows.
std::vector<double> transfer_power(const MultiBounceInput& input, const SparseRows& rows, int bounces);

}  // namespace relight::direct_to_indirect
