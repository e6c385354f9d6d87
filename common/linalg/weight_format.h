// How the elements of a stored transfer matrix are written down. The quantised formats hold signed integers
// times a scale (a row of a row-based form, Hasan 2006 section 5 a block of an image-based one), so that zero
// stays exactly zero.
#pragma once

#include <span>
#include <string>

#include "common/linalg/sparse_rows.h"

namespace relight {

enum class WeightFormat { float32, bits16, bits8 };

// "float32", "16", "8": the choices of the knob `weights`. from_string throws Error naming them.
std::string to_string(WeightFormat format);
WeightFormat weight_format_from_string(const std::string& name);
// Bytes of one stored weight.
int bytes_of(WeightFormat format);
// The step of a quantised format for these entries, 1 for float32: |value / step| <= largest_integer. Never
// 0, so that rows of zeros and of denormals can be divided by it.
float quantisation_step(std::span<const SparseEntry> entries, WeightFormat format);
// The same for the largest magnitude of some entries.
float quantisation_step(float largest, WeightFormat format);
// Largest integer of a quantised format (127 or 32767); throws std::logic_error for float32.
int largest_integer(WeightFormat format);

}  // namespace relight
