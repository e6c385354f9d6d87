// A method with a known error and a known cost: the reference's own picture, made brighter.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight::test {

// Knobs `quality` (precompute) and `detail` (relight), both 1 to 64 by factors of 2. The relative error is
// 0.4 / quality
// + 0.2 / detail, the memory (quality + 3 detail) MB. `overfit`: under lightings other than `omni` it is 0.5
// more. Relights are counted in `relights`. Its picture is the reference's for the same seed and 256 samples
// a pixel.
std::unique_ptr<Method> make_scaled_method(int& relights, bool overfit = false);

inline double scaled_error(double quality, double detail) { return 0.4 / quality + 0.2 / detail; }

}  // namespace relight::test
