// Cases that every method is put to alike.
#pragma once

#include <functional>
#include <memory>

#include "common/hard_cases/hard_case.h"
#include "common/hard_cases/method_bench.h"

namespace relight::hard {

// The tiny room, a thousand times smaller and larger, with lights whose intensity goes with the area: the
// pictures must be the same. By powers of two they are to the bit but for absolute lengths; by powers of ten
// a comparison of floats may fall otherwise, so that samples are chosen anew. `bound`, `why`: of how much the
// norm of indirect light may change then.
Case scale_case(std::function<std::unique_ptr<Method>()> make, KnobList knobs, double bound, std::string why);

}  // namespace relight::hard
