#include "common/scene/files/scene_toml.h"

#include <algorithm>

#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>

#include "common/run/error.h"
#include "common/scene/builtin/builtin.h"
#include "common/scene/files/framing.h"
#include "common/scene/files/image_file.h"
#include "common/scene/files/light_file.h"
#include "common/scene/files/material_toml.h"
#include "common/scene/files/mesh_file.h"
#include "common/scene/files/toml_reader.h"
#include "common/scene/validation.h"

namespace relight {

namespace {

// scale, then rotate about x, y, z in this order, then translate.
glm::mat4 read_transform(const TomlTable& table) {
  const glm::vec3 move = table.vector("translate", glm::vec3(0.0f));
  const glm::vec3 angles = glm::radians(table.vector("rotate_degrees", glm::vec3(0.0f)));
  const glm::vec3 scale = table.colour("scale", glm::vec3(1.0f));
  if (scale.x * scale.y * scale.z == 0.0f) fail("{}: a scale of 0 flattens the mesh", table.where("scale"));
  glm::mat4 m = glm::translate(glm::mat4(1.0f), move);
  m = glm::rotate(m, angles.z, glm::vec3(0, 0, 1));
  m = glm::rotate(m, angles.y, glm::vec3(0, 1, 0));
  m = glm::rotate(m, angles.x, glm::vec3(1, 0, 0));
  return glm::scale(m, scale);
}

void read_mesh(const TomlTable& table, Scene& scene) {
  table.require("file");
  MeshFileOptions options;
  options.transform = read_transform(table);
  options.srgb_colours = table.text("colours", "linear", {"linear", "srgb"}) == "srgb";
  options.object_prefix = table.text("prefix", "");
  const std::filesystem::path file = table.file("file");
  table.refuse_unknown_keys();
  if (!is_mesh_file_name(file))
    fail("{}: '{}' is not a mesh file; valid endings: .obj, .gltf, .glb, .ply", table.where("file"),
         file.string());
  if (!std::filesystem::is_regular_file(file))
    fail("{}: no such mesh file: {}", table.where("file"), file.string());
  append_mesh_file(scene, file, options);
}

void read_camera(const TomlTable& table, Camera& camera) {
  camera.eye = table.vector("eye", camera.eye);
  camera.target = table.vector("target", camera.target);
  camera.up = table.vector("up", camera.up);
  camera.fov_y_degrees =
      static_cast<float>(table.number("fov_y_degrees", double(camera.fov_y_degrees), {1.0, 170.0}));
  table.refuse_unknown_keys();
  const glm::vec3 forward = camera.target - camera.eye;
  if (!(glm::length(forward) > 0.0f)) fail("{}: eye and target are the same point", table.where());
  if (!(glm::length(glm::cross(forward, camera.up)) > 1e-6f * glm::length(forward) * glm::length(camera.up)))
    fail("{}: up is parallel to the direction of view, or zero", table.where());
}

// [view.NAME] tables: fields that one leaves out are the camera's.
void read_views(const TomlTable& table, Scene& scene) {
  for (const std::string& name : table.keys()) {
    if (name.empty() || name.find_first_not_of(view_name_characters) != std::string::npos)
      fail("{}: the name of a view is of letters, digits, '_' and '-'", table.where(name));
    Camera camera = scene.camera;
    read_camera(table.table(name), camera);
    scene.views[name] = camera;
  }
}

void read_environment(const TomlTable& table, Environment& environment) {
  const std::filesystem::path file = table.file("file");
  environment.radiance = table.colour("radiance", glm::vec3(file.empty() ? 0.0f : 1.0f), {0.0});
  environment.rotation_y = glm::radians(static_cast<float>(table.number("rotate_degrees", 0.0)));
  table.refuse_unknown_keys();
  if (file.empty()) return;
  if (!std::filesystem::is_regular_file(file))
    fail("{}: no such image file: {}", table.where("file"), file.string());
  load_environment_map(file, environment);
}

Scene read_geometry(const TomlTable& table, const std::filesystem::path& file) {
  const std::string base = table.text("base", "");
  if (!base.empty() && !is_builtin_scene(base)) {
    std::vector<std::string> names;
    for (const BuiltinScene& s : builtin_scenes()) names.push_back(s.name);
    fail("{}: no built-in scene '{}'; valid: {}", table.where("base"), base, fmt::join(names, ", "));
  }
  Scene scene;
  if (!base.empty()) scene = build_builtin_scene(base);
  scene.name = file.string();
  const std::vector<TomlTable> meshes = table.tables("mesh");
  if (base.empty() && meshes.empty())
    fail("{}: neither a base scene nor a [[mesh]]: nothing to show", file.string());
  for (const TomlTable& mesh : meshes) read_mesh(mesh, scene);
  if (!meshes.empty()) repair_scene(scene);
  return scene;
}

}  // namespace

Scene load_scene_toml(const std::filesystem::path& file) {
  const TomlTable table = TomlTable::parse_file(file);
  // Keys are checked before the meshes, so that a typo does not cost the time of loading them.
  for (const char* key :
       {"base", "mesh", "material", "camera", "view", "exposure", "lighting", "environment"})
    table.has(key);
  table.refuse_unknown_keys();
  Scene scene = read_geometry(table, file);
  for (const TomlTable& material : table.tables("material")) read_material(material, scene);
  repair_materials(scene);
  finish_scene(scene);
  if (!table.has("base")) scene.camera = frame_bounds(scene.bounds);
  read_camera(table.table("camera"), scene.camera);
  read_views(table.table("view"), scene);
  scene.exposure = static_cast<float>(table.number("exposure", double(scene.exposure), {0.0, 1e30, true}));
  const TomlTable lightings = table.table("lighting");
  for (const std::string& preset : lightings.keys())
    scene.lightings[preset] = read_lights(lightings, preset, preset);
  if (scene.lightings.empty()) add_default_lightings(scene);
  read_environment(table.table("environment"), scene.environment);
  finish_scene(scene);
  return scene;
}

}  // namespace relight
