#include "common/lights/light_words.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "common/run/error.h"

namespace relight {

namespace {

std::string show(const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

}  // namespace

const std::vector<std::string>& light_type_names() {
  static const std::vector<std::string> names = {"omni", "spot", "directional", "rectangle", "disc"};
  return names;
}

std::string to_string(LightType type) { return light_type_names().at(static_cast<size_t>(type)); }

LightType light_type_of(const std::string& name) {
  const std::vector<std::string>& names = light_type_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) fail("light type '{}'; valid: {}", name, fmt::join(names, ", "));
  return static_cast<LightType>(found - names.begin());
}

std::string describe(const Light& light) {
  std::string text = fmt::format("{} position {} direction {} intensity {}", to_string(light.type),
                                 show(light.position), show(light.direction), show(light.intensity));
  if (light.type == LightType::spot)
    text += fmt::format(" inner {} outer {} degrees", light.inner_degrees, light.outer_degrees);
  if (light.type == LightType::rectangle)
    text += fmt::format(" edges {} {}", show(light.edge_u), show(light.edge_v));
  if (light.type == LightType::disc) text += fmt::format(" radius {}", light.radius);
  return text + (light.casts_shadows ? "" : " without shadows");
}

}  // namespace relight
