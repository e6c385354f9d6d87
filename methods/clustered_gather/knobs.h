// The knob table of clustered gather.
#pragma once

#include "common/run/knobs.h"

namespace relight::clustered_gather {

KnobTable knob_table();

}  // namespace relight::clustered_gather
