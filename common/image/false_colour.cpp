#include "common/image/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/run/error.h"

namespace relight {

namespace {

// viridis at 0, 1/9, ... 1, sRGB-encoded.
constexpr std::array<unsigned, 10> viridis = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                              0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};

glm::dvec3 colour_of(unsigned hex) { return glm::dvec3(hex >> 16, hex >> 8 & 0xff, hex & 0xff) / 255.0; }

double decode_srgb(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

double difference(const glm::vec3& a, const glm::vec3& r) {
  const glm::dvec3 d = glm::abs(glm::dvec3(a) - glm::dvec3(r));
  return (d.x + d.y + d.z) / 3.0;
}

void require_same_size(const Image& a, const Image& r) {
  if (a.width != r.width || a.height != r.height)
    fail("can't show the difference of images of {} x {} and {} x {} pixels", a.width, a.height, r.width,
         r.height);
}

}  // namespace

glm::vec3 false_colour(double t) {
  if (!std::isfinite(t)) return {1.0f, 0.0f, 1.0f};
  const double at = std::clamp(t, 0.0, 1.0) * (viridis.size() - 1);
  const size_t i = std::min(static_cast<size_t>(at), viridis.size() - 2);
  const glm::dvec3 encoded =
      glm::mix(colour_of(viridis[i]), colour_of(viridis[i + 1]), at - static_cast<double>(i));
  return {decode_srgb(encoded.x), decode_srgb(encoded.y), decode_srgb(encoded.z)};
}

Image difference_image(const Image& a, const Image& r, double full_scale) {
  require_same_size(a, r);
  if (!(full_scale > 0.0)) fail("the full scale of a difference image must be above 0, not {}", full_scale);
  Image result(a.width, a.height);
  for (size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = false_colour(difference(a.pixels[i], r.pixels[i]) / full_scale);
  return result;
}

double difference_scale(const Image& a, const Image& r) {
  require_same_size(a, r);
  std::vector<double> finite;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    if (const double d = difference(a.pixels[i], r.pixels[i]); std::isfinite(d)) finite.push_back(d);
  if (finite.empty()) return 0.0;
  const auto at = finite.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(finite.size() - 1));
  std::nth_element(finite.begin(), at, finite.end());
  return *at > 0.0 ? *at : *std::max_element(finite.begin(), finite.end());
}

}  // namespace relight
