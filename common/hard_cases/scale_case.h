// Cases that every method is put to alike.
#pragma once

#include <functional>
#include <memory>

#include "common/hard_cases/hard_case.h"
#include "common/hard_cases/method_bench.h"

namespace relight::hard {

// The tiny room, a thousand times smaller and larger, with lights whose intensity goes with the area: the
// pictures must be the same. `bound`, `why`: of the relative difference of indirect light.
Case scale_case(std::function<std::unique_ptr<Method>()> make, KnobList knobs, double bound, std::string why);

}  // namespace relight::hard
