// Values of the 16 view samples of a tile side by side, so that loops over them vectorise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace relight::direct_to_indirect {

constexpr int lanes = 16;
using Lanes = std::array<float, lanes>;  // one value a view sample of the tile

// An element, or a wavelet coefficient, of all 16 rows.
struct LaneCoefficient {
  uint32_t index;
  Lanes value;
};

// Bit i is flags[i], each 0 or 1.
inline uint32_t to_mask(const std::array<uint32_t, lanes>& flags) {
#ifdef __AVX2__
  const auto half = [&](size_t first) {
    const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(flags.data() + first));
    return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(v, 31))));
  };
  return half(0) | half(8) << 8;
#else
  uint32_t mask = 0;
  for (uint32_t i = 0; i < lanes; ++i) mask |= flags[i] << i;
  return mask;
#endif
}

}  // namespace relight::direct_to_indirect
