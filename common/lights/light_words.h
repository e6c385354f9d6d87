// Lights in words: the names of their types, as lighting files write them, and whole lights as text.
#pragma once

#include <string>
#include <vector>

#include "common/lights/light.h"

namespace relight {

// "omni", "spot", ...
std::string to_string(LightType type);
// All of them, in the order of LightType.
const std::vector<std::string>& light_type_names();
// The inverse of to_string(). Throws Error listing the valid names.
LightType light_type_of(const std::string& name);

// Everything that decides what the light gives, in words and exact decimal numbers; its name is left out.
// Stored references and cached pictures are known by it: another wording makes all of them stale.
std::string describe(const Light& light);

// The lights of a lighting, a line each, with their keyframes.
std::string describe(const LightingState& lighting);

}  // namespace relight
