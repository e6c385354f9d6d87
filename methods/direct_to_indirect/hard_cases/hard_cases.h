// The hard cases of direct-to-indirect transfer: see common/hard_cases/hard_case.h.
#pragma once

#include "common/hard_cases/hard_case.h"

namespace relight::direct_to_indirect {

hard::Cases hard_cases();

// Its parts.
hard::Cases precompute_cases();
hard::Cases glossy_cases();
hard::Cases light_cases();
hard::Cases view_cases();
hard::Cases environment_cases();
hard::Cases surface_cases();

}  // namespace relight::direct_to_indirect
