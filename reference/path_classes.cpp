#include "reference/path_classes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace relight {

std::string PathClass::name() const {
  constexpr const char* ends[] = {"local", "area", "environment"};
  const char* end_name = ends[static_cast<int>(end)];
  if (bounces < 0) return fmt::format("seen.{}", end_name);
  const char* eye = glossy_at_eye ? "G" : "D";
  const char* interior = bounces == 0 ? "" : glossy_interior ? ".some_G" : ".D";
  return fmt::format("b{}{}.{}{}.{}", bounces, or_more ? "+" : "", eye, interior, end_name);
}

PathClasses::PathClasses(int most_bounces, const LightPaths& paths, bool glossy, bool area, bool environment)
    : told_apart_(true) {
  const auto last_of = [&](LightEnd end) {
    return end == LightEnd::environment ? paths.last_environment_bounce() : paths.max_bounces;
  };
  const int longest =
      environment ? std::max(paths.max_bounces, last_of(LightEnd::environment)) : paths.max_bounces;
  if (longest < paths.min_bounces) return;  // direct light alone
  last_ = std::clamp(most_bounces + 1, paths.min_bounces, longest);
  place_.assign(slot(last_ + 1, LightEnd::local, 0, 0), -1);
  for (int bounces = paths.min_bounces; bounces <= last_; ++bounces)
    for (const LightEnd end : {LightEnd::local, LightEnd::area, LightEnd::environment}) {
      if (end == LightEnd::area && !area) continue;
      if (end == LightEnd::environment && !environment) continue;
      if (end == LightEnd::local && bounces == 0) continue;  // exact, in the direct image
      if (bounces > last_of(end)) continue;
      for (int eye = 0; eye <= (glossy && paths.glossy_at_eye ? 1 : 0); ++eye)
        for (int interior = 0; interior <= (glossy && paths.glossy_interior && bounces > 0 ? 1 : 0);
             ++interior) {
          place_[slot(bounces, end, eye, interior)] = static_cast<int>(classes_.size());
          const bool or_more = bounces == last_ && last_ < last_of(end);
          classes_.push_back({bounces, or_more, eye == 1, interior == 1, end});
        }
    }
}

void PathClasses::add_apart(int bounces, LightEnd end, const SplitRadiance& radiance, glm::vec3* sums) const {
  for (int eye = 0; eye < 2; ++eye)
    for (int interior = 0; interior < 2; ++interior) {
      const glm::vec3& value = radiance.value[eye][interior];
      if (value == glm::vec3(0.0f)) continue;
      const int place = place_[slot(std::min(bounces, last_), end, eye, interior)];
      if (place < 0 && !std::isfinite(value.x + value.y + value.z)) {
        sums[0] +=
            value;  // of a lobe that is not there, 0 x NaN: the sample is counted and dropped as a whole
        continue;
      }
      if (place < 0)
        throw std::logic_error(fmt::format("path classes: light from {} bounces that cannot occur", bounces));
      sums[place] += value;
    }
}

}  // namespace relight
