// The relative errors that a waterfall is made of, on pictures of a few pixels, with the uncertainty that
// comes from their being few.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace relight {

// |A-B|_2 / |R|_2 in three forms: of the total as the papers measure it (x exposure, clamped to [0,1]), the
// same without edge pixels, and of the indirect light alone, linear: neither exposed nor clamped.
struct Measure {
  enum Kind : size_t { relative, relative_edges_out, indirect_linear };
};
constexpr size_t measure_count = 3;
const std::array<std::string, measure_count>& measure_names();  // "relative", ...
using Measures = std::array<double, measure_count>;

// What one setting of a method, or the reference, shows on the subset.
struct Picture {
  Image total, indirect;
};

// Where pixels lie: which are edges, and which of the independent blocks each belongs to.
struct PictureLayout {
  std::vector<uint8_t> edge;  // one a pixel, not 0 = edge
  std::vector<int> block;     // one a pixel, 0 .. blocks - 1
  float exposure = 1.0f;
};

// |A-B|^2 and |R|^2 by block, which all measures and their uncertainty follow from.
struct BlockSums {
  std::vector<double> difference, reference;
};
// Throws Error if pictures or layout differ in size.
BlockSums block_sums(const Picture& a, const Picture& b, const Picture& reference,
                     const PictureLayout& layout, Measure::Kind measure);

// sqrt(sum of differences / sum of references); NaN if the reference is black.
double share(const BlockSums& sums);

// Half width of the 95 % interval of share(from) - share(to) over the choice of blocks, by the delete-one
// jackknife (Tukey 1958); NaN for fewer than two blocks. An empty `to` counts as 0.
double half_width_of_drop(const BlockSums& from, const BlockSums& to);

}  // namespace relight
