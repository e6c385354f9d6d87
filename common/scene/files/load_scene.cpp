#include <filesystem>

#include <fmt/ranges.h>

#include "common/run/error.h"
#include "common/scene/builtin/builtin.h"

namespace relight {

namespace {

std::vector<std::string> builtin_names() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  return names;
}

}  // namespace

Scene load_scene(const std::string& name_or_file) {
  if (is_builtin_scene(name_or_file)) return build_builtin_scene(name_or_file);
  fail("no built-in scene and no readable file '{}'; built-in scenes: {}", name_or_file,
       fmt::join(builtin_names(), ", "));
}

LightingState load_lighting(const Scene& scene, const std::string& preset_or_file) {
  if (const auto found = scene.lightings.find(preset_or_file); found != scene.lightings.end())
    return found->second;
  std::vector<std::string> presets;
  for (const auto& [name, lighting] : scene.lightings) presets.push_back(name);
  fail("scene '{}' has no lighting preset '{}'; presets: {}", scene.name, preset_or_file,
       fmt::join(presets, ", "));
}

}  // namespace relight
