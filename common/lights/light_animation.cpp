#include "common/lights/light_animation.h"

#include <algorithm>
#include <limits>

#include "common/run/error.h"

namespace relight {

namespace {

// Slope of the spline at keyframe k.
glm::dvec3 tangent(const LightTrack& track, size_t k) {
  const size_t before = k > 0 ? k - 1 : k, after = std::min(k + 1, track.times.size() - 1);
  return (glm::dvec3(track.values[after]) - glm::dvec3(track.values[before])) /
         (track.times[after] - track.times[before]);
}

FieldValues values_at(const AnimatedLight& animated, double time) {
  FieldValues values = animated.base;
  for (const LightTrack& track : animated.tracks) values[track.field] = track.at(time);
  return values;
}

}  // namespace

glm::vec3 LightTrack::at(double time) const {
  if (time <= times.front()) return values.front();
  if (time >= times.back()) return values.back();
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  const auto k = static_cast<size_t>(next - times.begin()) - 1;
  const glm::dvec3 a(values[k]), b(values[k + 1]);
  const double span = times[k + 1] - times[k], t = (time - times[k]) / span;
  if (values[k] == values[k + 1] && !spline) return values[k];
  if (!spline) return glm::vec3(a + (b - a) * t);
  const double t2 = t * t, t3 = t2 * t;
  return glm::vec3((2.0 * t3 - 3.0 * t2 + 1.0) * a + (t3 - 2.0 * t2 + t) * span * tangent(*this, k) +
                   (3.0 * t2 - 2.0 * t3) * b + (t3 - t2) * span * tangent(*this, k + 1));
}

double LightAnimation::first_time() const {
  double first = std::numeric_limits<double>::infinity();
  for (const AnimatedLight& light : lights)
    for (const LightTrack& track : light.tracks) first = std::min(first, track.times.front());
  return first;
}

double LightAnimation::last_time() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const AnimatedLight& light : lights)
    for (const LightTrack& track : light.tracks) last = std::max(last, track.times.back());
  return last;
}

void set_sky_environment(LightingState& lighting) {
  const auto is_sky = [](const Light& light) { return light.type == LightType::sun_sky; };
  const auto found = std::find_if(lighting.lights.begin(), lighting.lights.end(), is_sky);
  if (found == lighting.lights.end()) return;
  if (std::count_if(lighting.lights.begin(), lighting.lights.end(), is_sky) > 1)
    fail("lighting '{}': more than one light of type sun_sky", lighting.name);
  lighting.environment = std::make_shared<const Environment>(sky_environment(found->sky));
}

LightingState lighting_at(const LightingState& lighting, double time) {
  LightingState still{lighting.name, lighting.lights, nullptr, lighting.environment};
  if (!lighting.animation) return still;
  for (const AnimatedLight& animated : lighting.animation->lights) {
    Light& light = still.lights.at(animated.light);
    set_light_fields(light, values_at(animated, time), [&](const std::string& field) {
      return fmt::format("lighting '{}': light '{}' at {} s: {}", lighting.name, light.name, time, field);
    });
  }
  validate(still);
  set_sky_environment(still);
  return still;
}

}  // namespace relight
