// TOML scene files; their format is described in docs/scenes.md.
#pragma once

#include <filesystem>

#include "common/scene/scene.h"

namespace relight {

// Loads, repairs and finishes the scene. Throws Error naming file, line, field, value and the valid choices.
Scene load_scene_toml(const std::filesystem::path& file);

}  // namespace relight
