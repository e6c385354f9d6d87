#include "common/lights/light_words.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "common/lights/light_animation.h"
#include "common/run/error.h"

namespace relight {

namespace {

std::string show(const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

std::string describe_beam(const Light& light) {
  const BeamShape& b = light.beam;
  return fmt::format(
      " right {} width {} + {} height {} + {} roundness {} shear {} {} from {} - {} to {} + {} falloff {} at "
      "{} "
      "slide {:016x}",
      show(light.right), b.width, b.width_edge, b.height, b.height_edge, b.roundness, b.shear_x, b.shear_y,
      b.cut_on, b.near_edge, b.cut_off, b.far_edge, b.falloff, b.falloff_distance,
      light.slide ? light.slide->content_hash : 0);
}

}  // namespace

const std::vector<std::string>& light_type_names() {
  static const std::vector<std::string> names = {"omni",      "spot", "directional", "rectangle", "disc",
                                                 "projector", "uber", "sun_sky",     "shader"};
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
  if (has_beam(light.type)) text += describe_beam(light);
  if (light.type == LightType::sun_sky)
    text += fmt::format(" elevation {} azimuth {} turbidity {} scale {}", light.sky.elevation_degrees,
                        light.sky.azimuth_degrees, light.sky.turbidity, light.sky.scale);
  if (light.type == LightType::shader) {
    text += fmt::format(" right {} code {:016x}", show(light.right),
                        light.user_shader ? light.user_shader->content_hash : 0);
    for (const glm::vec3& p : light.parameters) text += ' ' + show(p);
  }
  return text + (light.casts_shadows ? "" : " without shadows");
}

std::string describe(const LightingState& lighting) {
  std::string text;
  for (size_t i = 0; i < lighting.lights.size(); ++i) {
    text += describe(lighting.lights[i]) + '\n';
    if (!lighting.animation) continue;
    for (const AnimatedLight& animated : lighting.animation->lights) {
      if (animated.light != i) continue;
      for (const LightTrack& track : animated.tracks) {
        text += fmt::format("  {}{}:", track.field, track.spline ? " by splines" : "");
        for (size_t k = 0; k < track.times.size(); ++k)
          text += fmt::format(" {} at {}", show(track.values[k]), track.times[k]);
        text += '\n';
      }
    }
  }
  return text;
}

}  // namespace relight
