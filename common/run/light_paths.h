// Which light paths a method carries, as data; the reference restricts itself to the same set.
#pragma once

#include <string>

namespace relight {

// Paths E x1 .. x(k+1) L with k bounces of indirect light, min_bounces <= k <= max_bounces (k = 0 is direct
// light and always carried; max_bounces = 0 with min_bounces = 1: nothing else is). Heckbert's notation: "E D
// D L" is one diffuse bounce.
struct LightPaths {
  int min_bounces = 1;
  int max_bounces = 1;
  bool glossy_at_eye = false;    // may the visible vertex reflect indirect light through its glossy lobe?
  bool glossy_interior = false;  // may the vertices behind it?
  bool environment = false;      // does light from the environment count?
  // Largest number of bounces of light from the environment; -1: max_bounces. Of few methods it is smaller.
  int environment_bounces = -1;
  bool emission = false;          // does light emitted by surfaces count?
  std::string to_string() const;  // e.g. "E D D L, 1 bounce, local lights"
  int last_environment_bounce() const { return environment_bounces < 0 ? max_bounces : environment_bounces; }
  // The same paths where there is no such light: what a scene without an environment leaves of them.
  LightPaths without_environment() const {
    LightPaths paths = *this;
    paths.environment = false;
    paths.environment_bounces = -1;
    return paths;
  }
};

}  // namespace relight
