// Which wavelet coefficients a row keeps (Hasan 2006 section 4.3, "area-weighted wavelet culling").
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {

struct Candidate {
  float weight;  // the larger, the more it deserves to be kept
  SparseEntry entry;
};

// The coefficients of a tile that deserve most to be kept, by lane, and sums over all of the lane's
// coefficients.
struct LaneSelection {
  std::array<std::vector<Candidate>, lanes> largest;  // in no particular order
  std::array<int64_t, lanes> count{};                 // coefficients that are not zero
  std::array<double, lanes> energy{};                 // sum of their squares
  // A guess at the weight of the lightest of the next tile's largest: only how long the selection takes
  // depends on it.
  Lanes guess{};
};

// Fills `out` with the `limit` coefficients of each lane that have the largest weight |c| x
// support^support_exponent x row_factor and are not zero; ties go to the smaller column.
void select_largest(const std::vector<LaneCoefficient>& coefficients, float support_exponent,
                    uint32_t columns, const Lanes& row_factor, size_t limit, LaneSelection& out);

// Keeps the `limit` candidates with the largest weight, ordered by column; ties go to the smaller column.
void keep_largest(std::vector<Candidate>& candidates, size_t limit);

// How many of the candidates with the largest weight it takes to hold `energy`, a sum of squared values; all
// of them if they do not. Reorders.
size_t count_for_energy(std::vector<Candidate>& candidates, double energy);

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
