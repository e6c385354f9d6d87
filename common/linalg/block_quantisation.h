// Weights of one block as integers of 8 or 16 bits with a scale and an offset (Hasan 2006 section 5; GPU Gems
// 3, listing 9-9): weight = step * (integer + origin).
#pragma once

#include <cstdint>
#include <span>

#include "common/linalg/weight_format.h"

namespace relight {

struct BlockQuantisation {
  float step = 1.0f, origin = 0.0f;
  // Largest error of a weight of the block, but for the rounding of the last bits of a float.
  float bound() const { return 0.5f * step; }
};

// For a quantised format. A block that contains zeros (half of the paper's are) gets them exactly: the origin
// is an integer then, and one step of the range is given up for it. Rounded zeros would light up what the
// light does not reach.
BlockQuantisation quantise_block(std::span<const float> weights, WeightFormat format);

// 0 to 255 or 65535.
uint32_t quantised(float weight, const BlockQuantisation& block, WeightFormat format);

}  // namespace relight
