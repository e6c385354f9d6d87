#include "experiments/mitsuba/emitters.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/lights/light_words.h"
#include "common/run/error.h"
#include "experiments/mitsuba/texture_file.h"

namespace relight::mitsuba {

namespace {

// Of the falloff picture: a band of a tenth of the cone then has 50 texels, and linear interpolation between
// them is within 3e-4 of the smoothstep.
constexpr int falloff_size = 1024;

// Mitsuba's own falloff, linear in the angle, is squeezed into this share of the cone: the picture has ours.
constexpr float beam_share = 0.9999f;

glm::vec3 across(const glm::vec3& axis) {
  return std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
}

void write_point(XmlWriter& xml, const Light& light) {
  xml.open("emitter", {{"type", "point"}});
  xml.leaf("point", {{"name", "position"},
                     {"x", text_of(light.position.x)},
                     {"y", text_of(light.position.y)},
                     {"z", text_of(light.position.z)}});
  xml.rgb("intensity", light.intensity);
  xml.close();
}

void write_spot(XmlWriter& xml, const Light& light, size_t index, const std::filesystem::path& folder) {
  const std::string file = fmt::format("textures/spot-{}.exr", index);
  write_texture(folder / file, spot_falloff(light));
  xml.comment(fmt::format(
      "full intensity within {} degrees of the axis, smoothstep of the cosine to 0 at {} degrees: "
      "the texture holds this falloff, Mitsuba's own is confined to the last {} of the angle",
      light.inner_degrees, light.outer_degrees, 1.0f - beam_share));
  xml.open("emitter", {{"type", "spot"}});
  // A target as far away as the position is from the origin, lest rounding turn the axis.
  const float ahead = std::max(1.0f, glm::length(light.position));
  xml.open("transform", {{"name", "to_world"}});
  xml.leaf("lookat", {{"origin", text_of(light.position)},
                      {"target", text_of(light.position + ahead * light.direction)},
                      {"up", text_of(across(light.direction))}});
  xml.close();
  xml.rgb("intensity", light.intensity);
  xml.number("cutoff_angle", light.outer_degrees);
  xml.number("beam_width", beam_share * light.outer_degrees);
  xml.open("texture", {{"type", "bitmap"}, {"name", "texture"}});
  xml.value("string", "filename", file);
  xml.value("boolean", "raw", "true");
  xml.value("string", "wrap_mode", "clamp");
  xml.close();
  xml.close();
}

// Mitsuba takes the first and last row as the poles themselves, we take each row's middle: with twice the
// rows and one, every other row falls on ours and the interpolation is the same.
Image map_with_poles(const Environment& environment) {
  const int width = environment.width, height = 2 * environment.height + 1;
  Image image(width, height);
  const auto texel = [&](int x, int y) {
    const int row = std::clamp(y, 0, environment.height - 1);
    return environment.texels[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int row = (y - 1) / 2;  // row y lies on the middle of `row` (odd y) or between it and the next
      const glm::vec3 value = y % 2 == 1 ? texel(x, row) : 0.5f * (texel(x, y / 2 - 1) + texel(x, y / 2));
      image.at(x, y) = environment.radiance * value;
    }
  return image;
}

}  // namespace

Image spot_falloff(const Light& light) {
  Light white = light;
  white.position = glm::vec3(0.0f), white.direction = {0, 0, 1}, white.intensity = glm::vec3(1.0f);
  const shader::LightParams params = white.params();
  const float edge = std::tan(glm::radians(light.outer_degrees));
  Image image(falloff_size, falloff_size);
  for (int y = 0; y < falloff_size; ++y)
    for (int x = 0; x < falloff_size; ++x) {
      const glm::vec2 p = edge * ((glm::vec2(x, y) + 0.5f) * (2.0f / falloff_size) - 1.0f);
      image.at(x, y) = shader::light_intensity(params, glm::normalize(glm::vec3(p, 1.0f)));
    }
  return image;
}

void write_light(XmlWriter& xml, const Light& light, size_t index, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings) {
  if (light.type != LightType::omni && light.type != LightType::spot)
    fail("light {} '{}' is of type {}; the export to Mitsuba knows omni, spot", index, light.name,
         to_string(light.type));
  xml.comment(fmt::format("light {} '{}'", index, light.name));
  if (!light.casts_shadows)
    warnings.push_back(fmt::format(
        "light {} '{}' has casts_shadows = false: Mitsuba's lights always cast shadows", index, light.name));
  if (light.type == LightType::omni) {
    write_point(xml, light);
  } else {
    write_spot(xml, light, index, folder);
  }
}

void write_environment(XmlWriter& xml, const Environment& environment, const std::filesystem::path& folder) {
  if (environment.black()) return;
  if (environment.texels.empty()) {
    xml.open("emitter", {{"type", "constant"}});
    xml.rgb("radiance", environment.radiance);
    return xml.close();
  }
  const std::string file = "textures/environment.exr";
  write_texture(folder / file, map_with_poles(environment));
  xml.open("emitter", {{"type", "envmap"}});
  xml.value("string", "filename", file);
  // Our map's middle column looks along -z, Mitsuba's first one does; and a map turned by rotation_y moves
  // what was at azimuth phi to phi - rotation_y, as a turn about y does.
  xml.open("transform", {{"name", "to_world"}});
  xml.leaf("rotate", {{"y", "1"}, {"angle", text_of(glm::degrees(environment.rotation_y) + 180.0f)}});
  xml.close();
  xml.close();
}

}  // namespace relight::mitsuba
