// Bilinear lookups of Texture and Environment. Texel (i, j) is a sample at its centre ((i + 0.5)/width,
// (j + 0.5)/height): an offset of half a texel here would shift every picture.
#include <cmath>
#include <numbers>

#include "common/scene/scene.h"

namespace relight {

namespace {

// Two neighbouring texels of one axis and the weight of the second.
struct Tap {
  int first, second;
  float weight;
};

// coordinate in texels, centres at i + 0.5; wraps around.
Tap wrapping_tap(float coordinate, int size) {
  const float shifted = coordinate - 0.5f;
  const float cell = std::floor(shifted);
  const int first = (static_cast<int>(cell) + size) % size;
  return {first, (first + 1) % size, shifted - cell};
}

Tap clamping_tap(float coordinate, int size) {
  const float last = static_cast<float>(size - 1);
  const float shifted = std::fmin(std::fmax(coordinate - 0.5f, 0.0f), last);
  const int first = std::min(static_cast<int>(shifted), size - 1);
  return {first, std::min(first + 1, size - 1), shifted - static_cast<float>(first)};
}

glm::vec3 bilinear(const std::vector<glm::vec3>& texels, int width, const Tap& x, const Tap& y) {
  const auto texel = [&](int column, int row) {
    return texels[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)];
  };
  const glm::vec3 low = glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.weight);
  const glm::vec3 high = glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.weight);
  return glm::mix(low, high, y.weight);
}

// Into [0, 1]. Not finite (which loading repairs) becomes 0, so that no index can leave the texels.
float wrap_unit(float x) {
  const float wrapped = x - std::floor(x);
  return wrapped >= 0.0f && wrapped <= 1.0f ? wrapped : 0.0f;
}

}  // namespace

glm::vec3 Texture::sample(const glm::vec2& uv) const {
  if (texels.empty()) return glm::vec3(1.0f);
  const Tap x = wrapping_tap(wrap_unit(uv.x) * static_cast<float>(width), width);
  const Tap y = wrapping_tap(wrap_unit(uv.y) * static_cast<float>(height), height);
  return bilinear(texels, width, x, y);
}

glm::vec3 Environment::lookup(const glm::vec3& d) const {
  if (texels.empty()) return radiance;
  constexpr float pi = std::numbers::pi_v<float>;
  // Turning the map by +rotation_y moves the content seen at azimuth phi to phi - rotation_y.
  const float azimuth = std::atan2(d.x, -d.z) + rotation_y;
  const float u = wrap_unit(0.5f + azimuth / (2.0f * pi));
  const float v = std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / pi;
  const Tap x = wrapping_tap(u * static_cast<float>(width), width);
  const Tap y = clamping_tap(v * static_cast<float>(height), height);
  return radiance * bilinear(texels, width, x, y);
}

}  // namespace relight
