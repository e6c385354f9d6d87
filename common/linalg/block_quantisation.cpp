#include "common/linalg/block_quantisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relight {
namespace {

double levels_of(WeightFormat format) { return 2.0 * largest_integer(format) + 1.0; }

}  // namespace

BlockQuantisation quantise_block(std::span<const float> weights, WeightFormat format) {
  if (weights.empty()) return {};
  const auto [lo, hi] = std::minmax_element(weights.begin(), weights.end());
  const bool has_zeros = std::find(weights.begin(), weights.end(), 0.0f) != weights.end();
  const double range = static_cast<double>(*hi) - static_cast<double>(*lo);
  // A step below the smallest normal float would be rounded, one far below the weights would need an origin
  // that a float does not hold.
  const double smallest = std::max(static_cast<double>(std::numeric_limits<float>::min()),
                                   std::abs(static_cast<double>(*lo)) * 0x1p-22);
  const double levels = levels_of(format) - (has_zeros ? 1.0 : 0.0);
  const auto step = static_cast<float>(std::max(range / levels, smallest));
  const float origin = *lo / step;
  return {step, has_zeros ? std::round(origin) : origin};
}

uint32_t quantised(float weight, const BlockQuantisation& block, WeightFormat format) {
  const double integer = std::round(static_cast<double>(weight) / static_cast<double>(block.step) -
                                    static_cast<double>(block.origin));
  return static_cast<uint32_t>(std::clamp(integer, 0.0, levels_of(format)));
}

}  // namespace relight
