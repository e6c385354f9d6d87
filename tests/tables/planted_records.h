// Records that no program wrote, with known errors and costs.
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/tables/points.h"

namespace relight::test {

// Of scene "box", lighting "spot", view 64x48. error: relative, as a share, +- half; edges out is half of it,
// indirect twice. Noise floor 0.1 %. Relight time [ms] with repeats from 0.9 to 1.1 times the median.
RunRecord planted(const std::string& method, const std::string& preset, double error, double half, double ms,
                  double megabytes = 10, double precompute_s = 1);

// One failed run: no errors, no times.
RunRecord planted_failure(const std::string& method, const std::string& why);

// The methods of issue 6: "exact" at 1 % in 10 ms, "too_dark" by 3 %, "leaks_nan", "slow" in ten times the
// time of "exact", and "path_tracing" at two budgets.
std::vector<RunRecord> planted_methods();

// The only group of these records; every run prepares data of its own.
tables::Group group_of(const std::vector<RunRecord>& records);

}  // namespace relight::test
