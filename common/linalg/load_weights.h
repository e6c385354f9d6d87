// Eight stored weights as floats in one AVX register, in steps of their row.
#pragma once

#include <immintrin.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/linalg/weight_format.h"

namespace relight {

inline __m256 load_weights(const float* at) { return _mm256_loadu_ps(at); }
inline __m256 load_weights(const int16_t* at) {
  return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at))));
}
inline __m256 load_weights(const int8_t* at) {
  return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at))));
}

// Writes weight number `at` of an array of the format; `value` in steps (quantisation_step).
inline void store_weight(WeightFormat format, float value, std::byte* weights, uint64_t at) {
  const auto put = [&](auto v) { std::memcpy(weights + at * sizeof(v), &v, sizeof(v)); };
  switch (format) {
    case WeightFormat::float32:
      return put(value);
    case WeightFormat::bits16:
      return put(static_cast<int16_t>(std::lrint(value)));
    case WeightFormat::bits8:
      return put(static_cast<int8_t>(std::lrint(value)));
  }
}

}  // namespace relight
