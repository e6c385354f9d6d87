// `relight bench --products`: the forms of the transfer product side by side, on the matrix and the lights of
// a scene.
#pragma once

#include <string>
#include <vector>

#include "experiments/session/options.h"

namespace relight {

struct ProductBenchOptions {
  SessionOptions session;
  std::vector<std::string> settings;  // direct_to_indirect.KNOB=VALUE, precompute knobs
  int repeats = 9;                    // of which minimum and median are reported
};

// Takes the final-gather matrix of direct_to_indirect from the cache (or computes it) and the scene's lights
// as wavelet lights. Returns two tables: for each form and format the time of a product, bytes, blocks,
// waste, culled share and relative error |y - y'| / |y'| against the double-precision oracle y'; and the same
// error when only the wavelet lights with the largest |light| x column norm are kept. Throws UsageError.
std::string run_product_bench(const ProductBenchOptions& options);

}  // namespace relight
