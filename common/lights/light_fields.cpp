#include "common/lights/light_fields.h"

#include <cmath>

#include "common/run/error.h"

namespace relight {

namespace {

using enum FieldKind;
using Where = std::function<std::string(const std::string&)>;
using Table = std::vector<LightField>;

const LightField intensity{"intensity", colour, true, 0.0};
const LightField radiance{"radiance", colour, true, 0.0};
const LightField position_field{"position", position, true};
const LightField direction_field{"direction", direction, false};
const LightField target{"target", position, false};
const LightField up{"up", direction, false};
constexpr const char* parameter_names[8] = {"parameter_1", "parameter_2", "parameter_3", "parameter_4",
                                            "parameter_5", "parameter_6", "parameter_7", "parameter_8"};

Table uber_fields() {
  return {intensity,
          position_field,
          direction_field,
          target,
          up,
          {"width", number, false, 0.0, 100.0, true},
          {"height", number, false, 0.0, 100.0, true},
          {"width_edge", number, false, 0.0, 100.0},
          {"height_edge", number, false, 0.0, 100.0},
          {"roundness", number, false, 0.0, 1.0},
          {"shear_x", number, false, -100.0, 100.0},
          {"shear_y", number, false, -100.0, 100.0},
          {"cut_on", number, false, 0.0},
          {"near_edge", number, false, 0.0},
          {"cut_off", number, false, 0.0, 1e30, true},
          {"far_edge", number, false, 0.0},
          {"falloff", number, false, 0.0, 10.0},
          {"falloff_distance", number, false, 0.0, 1e30, true}};
}

Table shader_fields() {
  Table table{intensity, position_field, direction_field, target, up};
  for (const char* name : parameter_names) table.push_back({name, colour, false});
  return table;
}

Table make_table(LightType type) {
  const LightField width{"width", number, true, 0.0, 1e30, true},
      height{"height", number, true, 0.0, 1e30, true};
  switch (type) {
    case LightType::omni:
      return {intensity, position_field};
    case LightType::spot:
      return {intensity,
              position_field,
              direction_field,
              target,
              {"outer_degrees", number, false, 0.0, 89.9, true},
              {"inner_degrees", number, false, 0.0, 89.9}};
    case LightType::directional:
      return {{"irradiance", colour, true, 0.0}, {"direction", direction, true}};
    case LightType::rectangle:
      return {radiance, position_field, direction_field, target, width, height, up};
    case LightType::disc:
      return {radiance, position_field, direction_field, target, {"radius", number, true, 0.0, 1e30, true}};
    case LightType::projector:
      return {intensity,
              position_field,
              direction_field,
              target,
              up,
              {"fov_degrees", number, false, 0.1, 170.0},
              {"aspect", number, false, 0.001, 1000.0}};
    case LightType::uber:
      return uber_fields();
    case LightType::sun_sky:
      return {{"elevation_degrees", number, true, least_elevation_degrees, 90.0},
              {"azimuth_degrees", number, false, -360.0, 360.0},
              {"turbidity", number, false, least_turbidity, largest_turbidity},
              {"scale", number, false, 0.0}};
    case LightType::shader:
      return shader_fields();
  }
  fail("a light of unknown type {}", static_cast<int>(type));
}

// The values of one light, with defaults.
struct Reader {
  const FieldValues& values;
  const Where& where;

  bool has(const char* name) const { return values.contains(name); }
  glm::vec3 vector(const char* name, const glm::vec3& fallback = {}) const {
    const auto found = values.find(name);
    return found == values.end() ? fallback : found->second;
  }
  float real(const char* name, float fallback) const { return vector(name, glm::vec3(fallback)).x; }

  // Unit; from `direction`, or from `target`.
  glm::vec3 axis(const glm::vec3& from) const {
    if (has("direction") == has("target"))
      fail("{}: this light needs either direction or target", where("type"));
    const glm::vec3 axis = has("target") ? vector("target") - from : vector("direction");
    if (!(glm::length(axis) > 0.0f))
      fail("{}: the light's axis has no length", where(has("target") ? "target" : "direction"));
    return glm::normalize(axis);
  }

  // Unit; to the right of one who looks along the axis with `up` above: +y, or +z if the axis is steep.
  glm::vec3 right(const glm::vec3& axis) const {
    const glm::vec3 above = vector("up", std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
    const glm::vec3 side = glm::cross(axis, above);
    if (!(glm::length(side) > 0.0f)) fail("{}: parallel to the light's direction", where("up"));
    return glm::normalize(side);
  }
};

void set_spot(Light& light, const Reader& read) {
  light.direction = read.axis(light.position);
  light.outer_degrees = read.real("outer_degrees", 25.0f);
  light.inner_degrees = read.real("inner_degrees", static_cast<float>(0.8 * double(light.outer_degrees)));
  if (!(light.inner_degrees < light.outer_degrees))
    fail("{}: {} is not below outer_degrees = {}; valid: 0 <= inner_degrees < outer_degrees < 90",
         read.where("inner_degrees"), light.inner_degrees, light.outer_degrees);
}

void set_rectangle(Light& light, const Reader& read) {
  light.direction = read.axis(light.position);
  // The width is horizontal; which of its ends is which does not matter.
  const glm::vec3 u = -read.right(light.direction);
  light.edge_u = 0.5f * read.real("width", 1.0f) * u;
  light.edge_v = 0.5f * read.real("height", 1.0f) * glm::normalize(glm::cross(light.direction, u));
}

void set_projector(Light& light, const Reader& read) {
  light.direction = read.axis(light.position);
  light.right = read.right(light.direction);
  const float aspect = light.slide ? float(light.slide->width) / float(light.slide->height) : 1.0f;
  light.beam = {};
  light.beam.width = std::tan(0.5f * glm::radians(read.real("fov_degrees", 40.0f)));
  light.beam.height = light.beam.width / read.real("aspect", aspect);
}

void set_uber(Light& light, const Reader& read) {
  light.direction = read.axis(light.position);
  light.right = read.right(light.direction);
  const BeamShape d = BeamShape::uber();
  light.beam = {read.real("width", d.width),
                read.real("height", d.height),
                read.real("width_edge", d.width_edge),
                read.real("height_edge", d.height_edge),
                read.real("roundness", d.roundness),
                read.real("shear_x", d.shear_x),
                read.real("shear_y", d.shear_y),
                read.real("cut_on", d.cut_on),
                read.real("near_edge", d.near_edge),
                read.real("cut_off", d.cut_off),
                read.real("far_edge", d.far_edge),
                read.real("falloff", d.falloff),
                read.real("falloff_distance", d.falloff_distance)};
  if (!(light.beam.cut_on < light.beam.cut_off))
    fail("{}: {} is not below cut_off = {}", read.where("cut_on"), light.beam.cut_on, light.beam.cut_off);
}

void set_sky(Light& light, const Reader& read) {
  const SkySettings d;
  light.sky = {read.real("elevation_degrees", d.elevation_degrees),
               read.real("azimuth_degrees", d.azimuth_degrees), read.real("turbidity", d.turbidity),
               read.real("scale", d.scale)};
  light.direction = -sun_direction(light.sky);
  light.intensity = sun_irradiance(light.sky);
}

void set_shader(Light& light, const Reader& read) {
  light.direction =
      read.has("direction") || read.has("target") ? read.axis(light.position) : glm::vec3(0, -1, 0);
  light.right = read.right(light.direction);
  for (size_t i = 0; i < light.parameters.size(); ++i) light.parameters[i] = read.vector(parameter_names[i]);
}

}  // namespace

const std::vector<LightField>& light_fields(LightType type) {
  static const std::vector<Table> tables = [] {
    std::vector<Table> all;
    for (int t = 0; t < light_type_count; ++t) all.push_back(make_table(static_cast<LightType>(t)));
    return all;
  }();
  return tables.at(static_cast<size_t>(type));
}

const LightField* find_light_field(LightType type, const std::string& name) {
  for (const LightField& field : light_fields(type))
    if (field.name == name) return &field;
  return nullptr;
}

void set_light_fields(Light& light, const FieldValues& values, const Where& where) {
  const Reader read{values, where};
  if (light.type == LightType::sun_sky) return set_sky(light, read);
  light.intensity = read.vector(light_fields(light.type).front().name, light.intensity);
  light.position = read.vector("position");
  if (light.type == LightType::spot) set_spot(light, read);
  if (light.type == LightType::directional) light.direction = read.axis({});
  if (light.type == LightType::rectangle) set_rectangle(light, read);
  if (light.type == LightType::disc) {
    light.direction = read.axis(light.position);
    light.radius = read.real("radius", 1.0f);
  }
  if (light.type == LightType::projector) set_projector(light, read);
  if (light.type == LightType::uber) set_uber(light, read);
  if (light.type == LightType::shader) set_shader(light, read);
}

}  // namespace relight
