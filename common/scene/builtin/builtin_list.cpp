#include <charconv>
#include <cmath>

#include <fmt/ranges.h>

#include "common/run/error.h"
#include "common/scene/builtin/builtin.h"
#include "common/scene/validation.h"

namespace relight {

namespace {

const std::vector<BuiltinGenerator>& generators() {
  static const std::vector<BuiltinGenerator> list = {cornell_scene(), colonnade_scene(), still_life_scene(),
                                                     hair_ball_scene(), temple_scene()};
  return list;
}

const BuiltinGenerator* find_generator(const std::string& name) {
  for (const BuiltinGenerator& g : generators())
    if (g.description.name == name) return &g;
  return nullptr;
}

std::vector<std::string> generator_names() {
  std::vector<std::string> names;
  for (const BuiltinGenerator& g : generators()) names.push_back(g.description.name);
  return names;
}

std::string parameter_list(const BuiltinScene& scene) {
  std::vector<std::string> names;
  for (const auto& p : scene.parameters)
    names.push_back(fmt::format("{} ({} to {}, default {})", p.name, p.min, p.max, p.default_value));
  return fmt::format("{}", fmt::join(names, ", "));
}

void set_parameter(const BuiltinScene& scene, const std::string& assignment,
                   std::map<std::string, double>& values) {
  const size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : assignment.substr(equals + 1);
  for (const auto& p : scene.parameters) {
    if (p.name != name) continue;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail("scene '{}': parameter '{}' has the value '{}', which is not a number", scene.name, name, text);
    if (!(value >= p.min && value <= p.max))
      fail("scene '{}': parameter '{}' is {}; valid: {} to {}", scene.name, name, value, p.min, p.max);
    values[name] = value;
    return;
  }
  fail("scene '{}' has no parameter '{}'; valid: {}", scene.name, name, parameter_list(scene));
}

}  // namespace

int BuiltinParameters::whole(const std::string& name) const {
  return static_cast<int>(std::lround(real(name)));
}

bool is_builtin_scene(const std::string& specification) {
  return find_generator(specification.substr(0, specification.find(':'))) != nullptr;
}

Scene build_builtin_scene(const std::string& specification) {
  const size_t colon = specification.find(':');
  const std::string name = specification.substr(0, colon);
  const BuiltinGenerator* generator = find_generator(name);
  if (!generator) fail("no built-in scene '{}'; valid: {}", name, fmt::join(generator_names(), ", "));
  const BuiltinScene& description = generator->description;
  std::map<std::string, double> values;
  for (const auto& p : description.parameters) values[p.name] = p.default_value;
  for (size_t at = colon; at != std::string::npos;) {
    const size_t comma = specification.find(',', at + 1);
    set_parameter(description,
                  specification.substr(at + 1, comma == std::string::npos ? comma : comma - at - 1), values);
    at = comma;
  }
  Scene scene;
  scene.name = specification;
  generator->build(BuiltinParameters(values), scene);
  compact_vertices(scene);  // seams and poles leave a few vertices that no triangle uses
  finish_scene(scene);
  return scene;
}

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> list = [] {
    std::vector<BuiltinScene> scenes;
    for (const BuiltinGenerator& g : generators()) scenes.push_back(g.description);
    return scenes;
  }();
  return list;
}

Light omni_light(const glm::vec3& position, const glm::vec3& intensity) {
  Light light;
  light.name = "omni";
  light.position = position;
  light.intensity = intensity;
  return light;
}

Light spot_light(const glm::vec3& position, const glm::vec3& target, const glm::vec3& intensity,
                 float inner_degrees, float outer_degrees) {
  Light light;
  light.name = "spot";
  light.type = LightType::spot;
  light.position = position;
  light.direction = glm::normalize(target - position);
  light.intensity = intensity;
  light.inner_degrees = inner_degrees;
  light.outer_degrees = outer_degrees;
  return light;
}

void add_lighting(Scene& scene, const std::string& name, std::vector<Light> lights) {
  scene.lightings[name] = {name, std::move(lights)};
}

}  // namespace relight
