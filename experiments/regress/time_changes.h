// Changes of times.
#pragma once

#include <vector>

#include "experiments/regress/changes.h"

namespace relight {

// Relight (its median and its fastest repeat: one disturbed repeat neither makes nor hides a change) and
// precompute, by ratio. Longer times are changes, shorter ones notes; both name the stage that moved most.
// Times that are too short to be told from the machine's noise are left out: see docs/regress.md.
void compare_times(const RunRecord& published, const RunRecord& fresh, double tolerance,
                   std::vector<Change>& out);

}  // namespace relight
