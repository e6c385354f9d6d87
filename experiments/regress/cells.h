// The cells of one run, for the table on the terminal and the page: "published -> fresh", one value if both
// read the same.
#pragma once

#include <string>

#include "experiments/regress/regress.h"

namespace relight {

struct RegressionCells {
  std::string relative, bias;  // per cent
  std::string relight;         // ms
  std::string precompute;      // s
  std::string changed;         // names of what changed, notes left out; "FAILED" first
};

RegressionCells cells_of(const RunComparison& run);

}  // namespace relight
