// Columns and weights as they lie in 32-bit words for the shaders (stored_weights.glsl), lowest bits first.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "common/linalg/weight_format.h"

namespace relight {

// Column i of a run of columns at `words`, which are zero before.
inline void pack_column(uint32_t column, bool narrow, uint32_t* words, size_t i) {
  if (narrow)
    words[i / 2] |= column << (16 * (i % 2));
  else
    words[i] = column;
}

// Weight i of a run of weights at `words`, which are zero before; `value` in steps (quantisation_step).
inline void pack_weight(float value, WeightFormat format, uint32_t* words, size_t i) {
  const auto integer = [&] { return static_cast<uint32_t>(std::lrint(value)); };
  switch (format) {
    case WeightFormat::float32:
      words[i] = std::bit_cast<uint32_t>(value);
      return;
    case WeightFormat::bits16:
      words[i / 2] |= (integer() & 0xffffu) << (16 * (i % 2));
      return;
    case WeightFormat::bits8:
      words[i / 4] |= (integer() & 0xffu) << (8 * (i % 4));
      return;
  }
}

}  // namespace relight
