// The knob table of direct-to-indirect transfer.
#pragma once

#include "common/run/knobs.h"

namespace relight::direct_to_indirect {

KnobTable knob_table();
std::vector<KnobPreset> knob_presets();

}  // namespace relight::direct_to_indirect
