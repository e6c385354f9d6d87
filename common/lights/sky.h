// Daylight: the sun as a directional light, the sky as an environment.
// This work is based on: A. J. Preetham, Peter Shirley, Brian Smits, "A Practical Analytic Model for
// Daylight", SIGGRAPH 1999.
// Does not do: ground light, clouds, twilight, nights; the sky's radiance includes the sun's glow but not its
// disc.
#pragma once

#include <glm/glm.hpp>

#include "common/lights/environment.h"

namespace relight {

struct SkySettings {
  float elevation_degrees = 45.0f;  // of the sun above the horizon
  float azimuth_degrees = 0.0f;     // of the sun: 0 towards -z, 90 towards +x
  float turbidity = 3.0f;           // 2 very clear .. 10 hazy
  float scale = 1.0f;               // factor on sun and sky
  bool operator==(const SkySettings&) const = default;
};

// The range in which the published fit gives linear sRGB that is positive everywhere, so that nothing needs
// to be clamped: below 2 degrees the sky beside the sun is redder than sRGB holds
// (tests/lights/sky_test.cpp).
inline constexpr float least_turbidity = 2.0f, largest_turbidity = 10.0f;
inline constexpr float least_elevation_degrees = 2.0f;

// Photometric units become radiometric ones by this efficacy of daylight [lm/W].
inline constexpr double luminous_efficacy = 179.0;

// Unit direction to the sun.
glm::vec3 sun_direction(const SkySettings& sky);

// Linear RGB irradiance of a surface that faces the sun [W/m^2]: sunlight outside the atmosphere less what
// molecules, aerosols and ozone take (their appendix A.1, at one wavelength a channel). Not negative.
glm::vec3 sun_irradiance(const SkySettings& sky);

// Linear RGB radiance of the sky in unit direction d [W/(m^2 sr)]; black below the horizon. Their equation 3
// and appendices A.2: Perez' distribution of luminance and chromaticity.
glm::vec3 sky_radiance(const SkySettings& sky, const glm::vec3& d);

// sky_radiance at the texel centres of a map of 2 size x size texels; size even.
Environment sky_environment(const SkySettings& sky, int size = 128);

}  // namespace relight
