// The numbers of a light, and how they change over time, from TOML tables.
#pragma once

#include <vector>

#include "common/lights/light_animation.h"
#include "common/scene/files/toml_reader.h"

namespace relight {

// The fields that the table has. Throws Error naming file, line, field and value for a value out of range or
// a required field that is missing.
FieldValues read_light_fields(const TomlTable& table, LightType type);

// The tracks of the light's [[...keyframe]] tables: one for each field that any of them names. Key `motion`:
// "linear", or "catmull_rom" for the path of position and target.
std::vector<LightTrack> read_keyframes(const TomlTable& table, LightType type);

}  // namespace relight
