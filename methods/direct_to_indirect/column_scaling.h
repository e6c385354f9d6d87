// Scales the columns of the final-gather matrix so that its rows are flatter and need fewer wavelet
// coefficients. Not in the paper: an exact change of variables,
//   v_i = sum_j F_ij g_j = sum_j (F_ij / w_j) (w_j g_j),
// with w_j the mean of F_ij over the view (plus a share of its own mean, so that columns that hardly any view
// sample sees are not blown up). What all rows have in common then no longer costs coefficients, and a
// truncated row errs in proportion to what the gather sample usually gives. The factor w_j is folded into the
// gather sample's albedo: relighting costs nothing more.
#pragma once

#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "methods/direct_to_indirect/final_gather.h"

namespace relight::direct_to_indirect {

// w_j for each gather sample of the ordered cloud, in units of its mean; from every eighth tile of the view,
// chosen by hash. All 1 if the view sees nothing. Deterministic for any number of threads.
std::vector<float> mean_row_scaling(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const GatherCloud& cloud, const GatherHierarchy& hierarchy,
                                    const FinalGatherSettings& settings);

}  // namespace relight::direct_to_indirect
