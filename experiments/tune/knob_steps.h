// Where a search may go from a knob's value, by what its table says (KnobTuning).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run/knobs.h"

namespace relight {

enum class Direction { cheaper, dearer };

// The next value in that direction; nothing at the end of the range, for a knob that is not tuned, and for a
// choice that is not among those worth trying. 0 where it lies outside of the range stands for "all", the
// dearest value.
std::optional<std::string> next_value(const Knob& knob, const std::string& value, Direction direction);

// Does it change nothing with the other knobs as they are?
bool idle(const Knob& knob, const KnobValues& values);

// The knobs that may be tuned: relight knobs first, because they reuse the precomputed data.
std::vector<const Knob*> tunable_knobs(const KnobTable& table);

}  // namespace relight
