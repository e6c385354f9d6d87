#include <filesystem>

#include <fmt/ranges.h>

#include "common/run/error.h"
#include "common/scene/builtin/builtin.h"
#include "common/scene/files/framing.h"
#include "common/scene/files/light_file.h"
#include "common/scene/files/mesh_file.h"
#include "common/scene/files/scene_toml.h"
#include "common/scene/validation.h"

namespace relight {

namespace {

std::vector<std::string> builtin_names() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  return names;
}

Scene load_bare_mesh(const std::filesystem::path& file) {
  Scene scene;
  scene.name = file.string();
  append_mesh_file(scene, file);
  repair_scene(scene);
  finish_scene(scene);
  scene.camera = frame_bounds(scene.bounds);
  add_default_lightings(scene);
  return scene;
}

}  // namespace

Scene load_scene(const std::string& name_or_file) {
  if (is_builtin_scene(name_or_file)) return build_builtin_scene(name_or_file);
  const std::filesystem::path file(name_or_file);
  if (is_mesh_file_name(file)) return load_bare_mesh(file);
  if (file.extension() == ".toml") return load_scene_toml(file);
  fail(
      "'{}' is neither a built-in scene ({}) nor a scene file (.toml) nor a mesh file (.obj, .gltf, .glb, "
      ".ply)",
      name_or_file, fmt::join(builtin_names(), ", "));
}

LightingState load_lighting(const Scene& scene, const std::string& preset_or_file) {
  if (const auto found = scene.lightings.find(preset_or_file); found != scene.lightings.end())
    return found->second;
  if (std::filesystem::path(preset_or_file).extension() == ".toml") return load_lighting_file(preset_or_file);
  std::vector<std::string> presets;
  for (const auto& [name, lighting] : scene.lightings) presets.push_back(name);
  fail("scene '{}' has no lighting preset '{}'; presets: {}; or name a .toml file with [[light]] tables",
       scene.name, preset_or_file, fmt::join(presets, ", "));
}

}  // namespace relight
