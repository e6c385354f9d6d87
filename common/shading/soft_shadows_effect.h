// Soft shadows as an effect that a method can leave out: how many points stand for a light with an area.
#pragma once

#include <string>

#include "common/run/effects.h"

namespace relight {

// Levels 1, 4, 16 and 64 points by one integer knob. What a level lacks is measured on direct light, exactly
// up to the points of the last level; what softer shadows change in indirect light is less and not measured.
// Needless where no rectangle or disc shines.
Effect soft_shadows_effect(const std::string& knob);

}  // namespace relight
