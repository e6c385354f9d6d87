// Which wavelet coefficients a row keeps (Hasan 2006 section 4.3, "area-weighted wavelet culling").
#pragma once

#include <functional>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {

struct Candidate {
  float weight;  // the larger, the more it deserves to be kept
  SparseEntry entry;
};

// The coefficients of one lane that are not zero, with weight |c| x support^support_exponent x row_factor.
void collect_candidates(const std::vector<LaneCoefficient>& coefficients, size_t lane, float support_exponent,
                        uint32_t columns, float row_factor, std::vector<Candidate>& out);

// Keeps the `limit` candidates with the largest weight, ordered by column; ties go to the smaller column.
void keep_largest(std::vector<Candidate>& candidates, size_t limit);

// How many of the candidates with the largest weight hold `fraction` of the energy of all, the sum of their
// squared values. Reorders.
size_t count_for_energy(std::vector<Candidate>& candidates, double fraction);

// Brightness of a view sample's row in the picture: the luminance of its k_d, or of the colour of its glossy
// part.
float row_factor(const SurfaceSample& sample, MatrixPart part);

// The weight above which a coefficient is kept when all rows share one budget of settings.budget(part) a row
// on average: measured on every eighth tile of the view, so that the number kept comes out within a few per
// cent. make_gather makes the walk of one thread. Deterministic.
float shared_budget_threshold(const DeepFrameBuffer& buffer, const FinalGatherSettings& settings,
                              MatrixPart part, uint32_t columns,
                              const std::function<TileGather()>& make_gather);

}  // namespace relight::direct_to_indirect
