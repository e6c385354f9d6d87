// Lights from TOML tables.
#pragma once

#include <filesystem>
#include <string>

#include "common/lights/light.h"
#include "common/scene/files/toml_reader.h"

namespace relight {

// Reads the array of light tables under `key`. Throws Error naming file, line, field and value.
LightingState read_lights(const TomlTable& table, const std::string& key, const std::string& name);

// A lighting file: [[light]] tables and an optional `name`.
LightingState load_lighting_file(const std::filesystem::path& file);

}  // namespace relight
