#include "common/scene/files/light_file.h"

#include <fstream>
#include <sstream>

#include "common/lights/light_fields.h"
#include "common/lights/light_words.h"
#include "common/run/error.h"
#include "common/scene/content_hash.h"
#include "common/scene/files/image_file.h"
#include "common/scene/files/keyframes_toml.h"

namespace relight {

namespace {

void read_slide(const TomlTable& table, Light& light) {
  if (light.type == LightType::projector) table.require("image");
  const std::filesystem::path file = table.file("image");
  if (file.empty()) return;
  if (!std::filesystem::is_regular_file(file))
    fail("{}: no such image file: {}", table.where("image"), file.string());
  light.slide = std::make_shared<const Slide>(load_slide(file));
}

void read_shader(const TomlTable& table, Light& light) {
  table.require("file");
  const std::filesystem::path file = table.file("file");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(file) || !(text << in.rdbuf()))
    fail("{}: no such shader file: {}", table.where("file"), file.string());
  ContentHash hash;
  hash.add_bytes(text.str().data(), text.str().size());
  light.user_shader =
      std::make_shared<const UserLightShader>(UserLightShader{file.string(), text.str(), hash.value()});
}

// Numbers first: of two faults, a missing number is told before an image that takes time to load.
Light read_light(const TomlTable& table, size_t index, LightAnimation& animation) {
  Light light;
  table.require("type");
  const std::string type = table.text("type", "", light_type_names());
  light.type = light_type_of(type);
  light.name = table.text("name", type);
  light.casts_shadows = table.boolean("casts_shadows", true);
  const FieldValues values = read_light_fields(table, light.type);
  if (has_beam(light.type)) read_slide(table, light);
  if (light.type == LightType::shader) read_shader(table, light);
  set_light_fields(light, values, [&](const std::string& field) { return table.where(field); });
  const std::vector<LightTrack> tracks = read_keyframes(table, light.type);
  table.refuse_unknown_keys();
  if (!tracks.empty()) animation.lights.push_back({index, values, tracks});
  return light;
}

// A fault in the values of a keyframe is found when the file is read, not when its frame is due.
void check_keyframes(const LightingState& lighting) {
  for (const AnimatedLight& light : lighting.animation->lights)
    for (const LightTrack& track : light.tracks)
      for (const double time : track.times) lighting_at(lighting, time);
}

}  // namespace

LightingState read_lights(const TomlTable& table, const std::string& key, const std::string& name) {
  LightingState lighting;
  lighting.name = name;
  LightAnimation animation;
  for (const TomlTable& light : table.tables(key))
    lighting.lights.push_back(read_light(light, lighting.lights.size(), animation));
  validate(lighting);
  set_sky_environment(lighting);
  if (!animation.lights.empty()) {
    lighting.animation = std::make_shared<const LightAnimation>(std::move(animation));
    check_keyframes(lighting);
  }
  return lighting;
}

LightingState load_lighting_file(const std::filesystem::path& file) {
  const TomlTable table = TomlTable::parse_file(file);
  const std::string name = table.text("name", file.stem().string());
  table.require("light");
  const LightingState lighting = read_lights(table, "light", name);
  table.refuse_unknown_keys();
  return lighting;
}

}  // namespace relight
