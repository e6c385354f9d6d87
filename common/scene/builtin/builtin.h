// The built-in procedural scenes: one file each, listed in builtin_list.cpp.
// To add one: write its file with a BuiltinGenerator, declare it here, and add it to the list.
#pragma once

#include <map>
#include <string>

#include "common/scene/scene_file.h"

namespace relight {

// Values of all parameters of the scene, checked against their ranges.
class BuiltinParameters {
 public:
  explicit BuiltinParameters(std::map<std::string, double> values) : values_(std::move(values)) {}
  double real(const std::string& name) const { return values_.at(name); }
  // Rounded to the nearest whole number.
  int whole(const std::string& name) const;
  uint64_t seed() const { return static_cast<uint64_t>(whole("seed")); }

 private:
  std::map<std::string, double> values_;
};

struct BuiltinGenerator {
  BuiltinScene description;
  // Fills geometry, materials, camera, exposure and lightings; name and finish_scene are the caller's.
  void (*build)(const BuiltinParameters& parameters, Scene& scene);
};

BuiltinGenerator cornell_scene();
BuiltinGenerator colonnade_scene();
BuiltinGenerator still_life_scene();
BuiltinGenerator hair_ball_scene();
BuiltinGenerator temple_scene();

// Builds from "name" or "name:param=value,...". Throws Error listing the valid names, parameters or range.
Scene build_builtin_scene(const std::string& specification);
// True if the part of the specification before ':' is a built-in name.
bool is_builtin_scene(const std::string& specification);

// Short forms for the scenes' light presets.
Light omni_light(const glm::vec3& position, const glm::vec3& intensity);
Light spot_light(const glm::vec3& position, const glm::vec3& target, const glm::vec3& intensity,
                 float inner_degrees, float outer_degrees);
// Adds the preset `name` with these lights.
void add_lighting(Scene& scene, const std::string& name, std::vector<Light> lights);

}  // namespace relight
