// The numbers of a light as lighting files and keyframes write them: one table a type, from which files are
// read, keyframes are checked and lights are made.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/lights/light.h"

namespace relight {

// number: .x of a vec3. colour: three numbers, or one for all three. position: moved by splines where asked.
enum class FieldKind { number, colour, position, direction };

struct LightField {
  const char* name;
  FieldKind kind;
  bool required;
  double min = -1e30, max = 1e30;
  bool open_min = false;  // min itself is not valid
};

// By name; a missing entry means the default, which docs/lights.md gives.
using FieldValues = std::map<std::string, glm::vec3>;

// The fields of a type, in the order of the documentation. `direction` and `target` of one light are two ways
// to say the same.
const std::vector<LightField>& light_fields(LightType type);
// Null if the type has no such field.
const LightField* find_light_field(LightType type, const std::string& name);

// Sets the numbers of `light`, whose type, slide and the like stay. Throws Error for values that don't fit
// each other; where("field") begins its message.
// A sun_sky light's direction and intensity follow from its numbers.
void set_light_fields(Light& light, const FieldValues& values,
                      const std::function<std::string(const std::string&)>& where);

}  // namespace relight
