// A method with effects of its own kinds, to see that the planner knows none by name.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight::test {

// Carries up to `depth` bounces (knob, 0 to 3), and has an effect "terms" that light paths can't tell apart:
// with n of 4 terms a hundredth of the picture of direct light is lacking for each of the 4 - n that are not
// there. "terms" is needless on scenes called "plain".
std::unique_ptr<Method> make_planted_method();

}  // namespace relight::test
