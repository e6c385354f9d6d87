#include "common/scene/files/light_file.h"

#include <cmath>

#include "common/lights/light_words.h"
#include "common/run/error.h"

namespace relight {

namespace {

// Direction from `direction`, or from `target`; one of the two is required.
glm::vec3 read_axis(const TomlTable& table, const glm::vec3& position) {
  if (table.has("direction") == table.has("target"))
    fail("{}: this light needs either direction or target", table.where("type"));
  const glm::vec3 axis =
      table.has("target") ? table.vector("target", {}) - position : table.vector("direction", {});
  if (!(glm::length(axis) > 0.0f))
    fail("{}: the light's axis has no length", table.where(table.has("target") ? "target" : "direction"));
  return glm::normalize(axis);
}

// A rectangle shines along `direction`; its width is horizontal (perpendicular to `up`).
void read_rectangle(const TomlTable& table, Light& light) {
  light.direction = read_axis(table, light.position);
  table.require("width");
  table.require("height");
  const auto width = static_cast<float>(table.number("width", 1.0, {0.0, 1e30, true}));
  const auto height = static_cast<float>(table.number("height", 1.0, {0.0, 1e30, true}));
  const glm::vec3 up =
      table.vector("up", std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
  const glm::vec3 u = glm::cross(up, light.direction);
  if (!(glm::length(u) > 0.0f)) fail("{}: parallel to the light's direction", table.where("up"));
  light.edge_u = 0.5f * width * glm::normalize(u);
  light.edge_v = 0.5f * height * glm::normalize(glm::cross(light.direction, u));
}

// What the light gives: W/sr, W/m^2 for directional, radiance for lights with an area.
const char* strength_of(LightType type) {
  if (type == LightType::directional) return "irradiance";
  return type == LightType::omni || type == LightType::spot ? "intensity" : "radiance";
}

Light read_light(const TomlTable& table) {
  Light light;
  table.require("type");
  const std::string type = table.text("type", "", light_type_names());
  light.type = light_type_of(type);
  light.name = table.text("name", type);
  const char* strength = strength_of(light.type);
  table.require(strength);
  light.intensity = table.colour(strength, {}, {0.0});
  if (light.type != LightType::directional) {
    table.require("position");
    light.position = table.vector("position", {});
  }
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
  if (light.type == LightType::directional) {
    table.require("direction");
    light.direction = read_axis(table, {});
  }
  if (light.type == LightType::rectangle) read_rectangle(table, light);
  if (light.type == LightType::disc) {
    light.direction = read_axis(table, light.position);
    table.require("radius");
    light.radius = static_cast<float>(table.number("radius", 1.0, {0.0, 1e30, true}));
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
