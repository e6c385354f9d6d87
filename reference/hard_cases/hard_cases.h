// The hard cases of the path tracer: see common/hard_cases/hard_case.h.
#pragma once

#include "common/hard_cases/hard_case.h"

namespace relight {

hard::Cases reference_hard_cases();

}  // namespace relight
