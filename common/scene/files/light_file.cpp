#include "common/scene/files/light_file.h"

#include "common/run/error.h"

namespace relight {

namespace {

// Direction from `direction`, or from `target`; one of the two is required.
glm::vec3 read_axis(const TomlTable& table, const glm::vec3& position) {
  if (table.has("direction") == table.has("target"))
    fail("{}: a spot needs either direction or target", table.where("type"));
  const glm::vec3 axis =
      table.has("target") ? table.vector("target", {}) - position : table.vector("direction", {});
  if (!(glm::length(axis) > 0.0f))
    fail("{}: the spot's axis has no length", table.where(table.has("target") ? "target" : "direction"));
  return glm::normalize(axis);
}

Light read_light(const TomlTable& table) {
  Light light;
  table.require("type");
  table.require("position");
  table.require("intensity");
  const std::string type = table.text("type", "", {"omni", "spot"});
  light.type = type == "spot" ? LightType::spot : LightType::omni;
  light.name = table.text("name", type);
  light.position = table.vector("position", {});
  light.intensity = table.colour("intensity", {}, {0.0});
  light.casts_shadows = table.boolean("casts_shadows", true);
  if (light.type == LightType::spot) {
    light.direction = read_axis(table, light.position);
    light.outer_degrees = static_cast<float>(table.number("outer_degrees", 25.0, {0.0, 89.9, true}));
    light.inner_degrees =
        static_cast<float>(table.number("inner_degrees", 0.8 * double(light.outer_degrees), {0.0, 89.9}));
    if (!(light.inner_degrees < light.outer_degrees))
      fail("{}: {} is not below outer_degrees = {}; valid: 0 <= inner_degrees < outer_degrees < 90",
           table.where("inner_degrees"), light.inner_degrees, light.outer_degrees);
  }
  table.refuse_unknown_keys();
  return light;
}

}  // namespace

LightingState read_lights(const TomlTable& table, const std::string& key, const std::string& name) {
  LightingState lighting;
  lighting.name = name;
  for (const TomlTable& light : table.tables(key)) lighting.lights.push_back(read_light(light));
  validate(lighting);
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
