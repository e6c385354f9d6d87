// Values of the 16 view samples of a tile side by side, so that loops over them vectorise.
#pragma once

#include <array>
#include <cstdint>

namespace relight::direct_to_indirect {

constexpr int lanes = 16;
using Lanes = std::array<float, lanes>;  // one value a view sample of the tile

// An element, or a wavelet coefficient, of all 16 rows.
struct LaneCoefficient {
  uint32_t index;
  Lanes value;
};

inline uint32_t to_mask(const std::array<uint32_t, lanes>& flags) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < lanes; ++i) mask |= flags[i] << i;
  return mask;
}

}  // namespace relight::direct_to_indirect
