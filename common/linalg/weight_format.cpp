#include "common/linalg/weight_format.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/run/error.h"

namespace relight {

std::string to_string(WeightFormat format) {
  switch (format) {
    case WeightFormat::float32:
      return "float32";
    case WeightFormat::bits16:
      return "16";
    case WeightFormat::bits8:
      return "8";
  }
  throw std::logic_error("to_string: not a weight format");
}

WeightFormat weight_format_from_string(const std::string& name) {
  for (const WeightFormat format : {WeightFormat::float32, WeightFormat::bits16, WeightFormat::bits8})
    if (name == to_string(format)) return format;
  fail("weight format '{}': expected float32, 16 or 8", name);
}

int bytes_of(WeightFormat format) {
  return format == WeightFormat::float32 ? 4 : format == WeightFormat::bits16 ? 2 : 1;
}

int largest_integer(WeightFormat format) {
  if (format == WeightFormat::float32) throw std::logic_error("largest_integer: float32 is not quantised");
  return format == WeightFormat::bits16 ? 32767 : 127;
}

float quantisation_step(std::span<const SparseEntry> entries, WeightFormat format) {
  float largest = 0.0f;
  for (const SparseEntry& e : entries) largest = std::max(largest, std::abs(e.value));
  return quantisation_step(largest, format);
}

float quantisation_step(float largest, WeightFormat format) {
  if (format == WeightFormat::float32) return 1.0f;
  // A step below the smallest normal number would be rounded, and largest / step would leave the integers.
  return std::max(largest / static_cast<float>(largest_integer(format)), std::numeric_limits<float>::min());
}

}  // namespace relight
