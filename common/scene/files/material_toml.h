// [[material]] tables of scene files.
#pragma once

#include "common/scene/files/toml_reader.h"
#include "common/scene/scene.h"

namespace relight {

// Overrides fields of every material of the table's name. Throws Error naming file, line, field and valid
// values.
void read_material(const TomlTable& table, Scene& scene);

}  // namespace relight
