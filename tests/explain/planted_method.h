// A method with known errors in known places, to see whether they are blamed on the right ones.
#pragma once

#include <memory>
#include <string>

#include "common/run/method.h"

namespace relight::test {

// Path traced pictures; each of the knobs `direct`, `dim` and `tint` is exact or wrong. Wrong: direct light
// times 1.3; indirect light times 0.8; indirect light of the green channel times 1.5. `dim` is a precompute
// knob, which takes 30 ms to make exact. Stages in that order. If `broken` is a stage's name: the setting
// with it exact gives NaN.
std::unique_ptr<Method> make_planted_method(const std::string& broken = "");

}  // namespace relight::test
