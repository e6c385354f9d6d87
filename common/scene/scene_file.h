// Scenes from files (OBJ, glTF/GLB, PLY through assimp; TOML scene files) and built-in names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace relight {

// name_or_file: a built-in name, optionally with parameters "cornell:boxes=2,seed=7"; a mesh file; or a .toml
// scene file. Validated and repaired. Throws Error naming the file, line, field, value and the valid choices.
Scene load_scene(const std::string& name_or_file);

struct BuiltinScene {
  std::string name, summary;
  struct Parameter {
    std::string name;
    double default_value, min, max;
    std::string help;
  };
  std::vector<Parameter> parameters;
};
const std::vector<BuiltinScene>& builtin_scenes();

// A preset of the scene, or a TOML file with [[light]] tables. Throws Error listing the presets.
LightingState load_lighting(const Scene& scene, const std::string& preset_or_file);

// Text for `relight scene info`: sizes, extent, closedness, albedo range, glossy share, environment, lights,
// repairs.
std::string describe_scene(const Scene& scene);

}  // namespace relight
