// The approximations that direct-to-indirect transfer consists of, in the order in which `relight
// explain-error` makes them exact: from the picture back to the gather cloud.
#pragma once

#include "common/run/error_stages.h"
#include "common/run/knobs.h"

namespace relight::direct_to_indirect {

ErrorStages error_stages(const KnobValues& knobs);

}  // namespace relight::direct_to_indirect
