#include "common/lights/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relight {

namespace {

constexpr double pi = std::numbers::pi;

// Perez' five parameters as linear functions of turbidity (appendix A.2).
struct Perez {
  double a, b, c, d, e;
  // cos_theta: of the direction's angle to the zenith, > 0; gamma: its angle to the sun.
  double at(double cos_theta, double gamma) const {
    const double cos_gamma = std::cos(gamma);
    return (1.0 + a * std::exp(b / cos_theta)) * (1.0 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }
};

Perez luminance_distribution(double t) {
  return {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
          -0.0670 * t + 0.3703};
}
Perez x_distribution(double t) {
  return {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
}
Perez y_distribution(double t) {
  return {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
}

// Luminance [cd/m^2] and chromaticity at the zenith (appendix A.2); s: the sun's angle to it.
double zenith_luminance(double t, double s) {
  const double chi = (4.0 / 9.0 - t / 120.0) * (pi - 2.0 * s);
  return 1e3 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
}

double cubic(double a, double b, double c, double d, double s) { return ((a * s + b) * s + c) * s + d; }

double zenith_x(double t, double s) {
  return t * t * cubic(0.00166, -0.00375, 0.00209, 0.0, s) +
         t * cubic(-0.02903, 0.06377, -0.03202, 0.00394, s) + cubic(0.11693, -0.21196, 0.06052, 0.25886, s);
}
double zenith_y(double t, double s) {
  return t * t * cubic(0.00275, -0.00610, 0.00317, 0.0, s) +
         t * cubic(-0.04214, 0.08970, -0.04153, 0.00516, s) + cubic(0.15346, -0.26756, 0.06670, 0.26688, s);
}

// Linear sRGB of chromaticity (x, y) and luminance.
glm::dvec3 rgb_of(double x, double y, double luminance) {
  const double big_x = x / y * luminance, big_z = (1.0 - x - y) / y * luminance;
  return {3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z,
          -0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z,
          0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z};
}

double sun_zenith_angle(const SkySettings& sky) {
  return 0.5 * pi - glm::radians(static_cast<double>(sky.elevation_degrees));
}

}  // namespace

glm::vec3 sun_direction(const SkySettings& sky) {
  const double s = sun_zenith_angle(sky), azimuth = glm::radians(static_cast<double>(sky.azimuth_degrees));
  return glm::vec3(std::sin(s) * std::sin(azimuth), std::cos(s), -std::sin(s) * std::cos(azimuth));
}

glm::vec3 sun_irradiance(const SkySettings& sky) {
  // Centres of the channels [micrometres], absorption of ozone there [1/cm], and a layer of 0.35 cm.
  constexpr double wavelength[3] = {0.610, 0.550, 0.465}, ozone[3] = {0.12, 0.085, 0.0075};
  constexpr double ozone_layer = 0.35;
  constexpr double solar_illuminance = 1.28e5;          // outside the atmosphere [lx]
  constexpr double solar_x = 0.3217, solar_y = 0.3326;  // chromaticity there
  const double s = sun_zenith_angle(sky), t = static_cast<double>(sky.turbidity);
  const double mass = 1.0 / (std::cos(s) + 0.15 * std::pow(93.885 - glm::degrees(s), -1.253));
  const double aerosols = 0.04608 * t - 0.04586;  // Angstrom's coefficient
  glm::dvec3 rgb = rgb_of(solar_x, solar_y, solar_illuminance / luminous_efficacy);
  for (int c = 0; c < 3; ++c) {
    const double molecules = 0.008735 * std::pow(wavelength[c], -4.08);
    const double haze = aerosols * std::pow(wavelength[c], -1.3);
    rgb[c] *= std::exp(-mass * (molecules + haze + ozone[c] * ozone_layer));
  }
  return glm::vec3(rgb * static_cast<double>(sky.scale));
}

glm::vec3 sky_radiance(const SkySettings& sky, const glm::vec3& d) {
  const double cos_theta = static_cast<double>(d.y);
  if (!(cos_theta > 0.0)) return glm::vec3(0.0f);
  const double t = static_cast<double>(sky.turbidity), s = sun_zenith_angle(sky);
  const double cos_gamma = glm::dot(glm::dvec3(d), glm::dvec3(sun_direction(sky)));
  const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
  // Equation 3: relative to the zenith, whose angle to the sun is s.
  const auto value = [&](const Perez& perez, double zenith) {
    return zenith * perez.at(cos_theta, gamma) / perez.at(1.0, s);
  };
  const double luminance = value(luminance_distribution(t), zenith_luminance(t, s));
  const double x = value(x_distribution(t), zenith_x(t, s)), y = value(y_distribution(t), zenith_y(t, s));
  return glm::vec3(rgb_of(x, y, luminance / luminous_efficacy) * static_cast<double>(sky.scale));
}

Environment sky_environment(const SkySettings& sky, int size) {
  Environment environment;
  environment.radiance = glm::vec3(1.0f);
  environment.width = 2 * size, environment.height = size;
  for (int row = 0; row < size; ++row) {
    const double theta = pi * (row + 0.5) / size;
    for (int column = 0; column < 2 * size; ++column) {
      const double azimuth = pi * ((column + 0.5) / size - 1.0);
      environment.texels.push_back(
          sky_radiance(sky, glm::vec3(std::sin(theta) * std::sin(azimuth), std::cos(theta),
                                      -std::sin(theta) * std::cos(azimuth))));
    }
  }
  return environment;
}

}  // namespace relight
