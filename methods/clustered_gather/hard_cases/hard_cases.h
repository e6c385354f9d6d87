// The hard cases of clustered gather: see common/hard_cases/hard_case.h.
#pragma once

#include "common/hard_cases/hard_case.h"

namespace relight::clustered_gather {

hard::Cases hard_cases();

// Its parts.
hard::Cases cluster_cases();
hard::Cases view_cases();
hard::Cases light_cases();

}  // namespace relight::clustered_gather
