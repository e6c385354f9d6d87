// Lights that change over time: keyframes of the numbers of a light, and the lighting at any time.
#pragma once

#include <vector>

#include "common/lights/light_fields.h"

namespace relight {

// One number or vector over time. Linear between keyframes, held before the first and after the last.
struct LightTrack {
  std::string field;
  std::vector<double> times;  // [s], increasing, at least one
  std::vector<glm::vec3> values;
  // Through the same values along a Catmull-Rom spline: cubic Hermite with the tangent at a keyframe from its
  // two neighbours, (v[k+1] - v[k-1]) / (t[k+1] - t[k-1]), at the ends from the only one (Catmull and Rom, "A
  // class of local interpolating splines", 1974, for uneven times).
  bool spline = false;
  glm::vec3 at(double time) const;
};

struct AnimatedLight {
  size_t light = 0;  // its index in the lighting
  FieldValues base;  // of fields that have no track
  std::vector<LightTrack> tracks;
};

struct LightAnimation {
  std::vector<AnimatedLight> lights;
  double first_time() const;  // of any keyframe [s]
  double last_time() const;
};

// Gives the lighting the environment of its sun_sky light, if it has one. Throws Error if it has two.
void set_sky_environment(LightingState& lighting);

// The lighting at a time [s], standing still (no animation). Throws Error naming light, time and field if the
// values between two keyframes make no light, e.g. directions that are opposite. A light whose values don't
// change stays equal bit by bit (same_light), so that light caches keep it.
LightingState lighting_at(const LightingState& lighting, double time);

}  // namespace relight
