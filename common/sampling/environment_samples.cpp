#include "common/sampling/environment_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int64_t most_texels = int64_t{1} << 20;

// Points of the map for each texel of the square, at least; see mean_radiance.
constexpr double points_a_texel = 1024.0;

// Parts that rows of the map are split into, whatever the number of threads: their sums are added in order.
constexpr size_t parts = 16;

// Bits of x < 2^16 to the even places.
uint32_t spread_bits(uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

// The even bits of a Morton number side by side.
uint32_t gather_bits(uint32_t x) {
  x &= 0x55555555u;
  x = (x | x >> 1) & 0x33333333u;
  x = (x | x >> 2) & 0x0f0f0f0fu;
  x = (x | x >> 4) & 0x00ff00ffu;
  return (x | x >> 8) & 0x0000ffffu;
}

uint32_t cell(double place, uint32_t side) {
  return std::min(static_cast<uint32_t>(std::max(place, 0.0) * side), side - 1);
}

// Bilinear interpolation at sub-cell k of `fine` along one axis of a texel: the offset of the other texel and
// its weight.
struct Tap {
  int neighbour;
  double weight;
};
Tap tap(int k, int fine) {
  const double offset = (k + 0.5) / fine - 0.5;
  return {offset < 0.0 ? -1 : 1, std::abs(offset)};
}

class MapSum {
 public:
  MapSum(const Environment& map, const EnvironmentSquare& square)
      : map_(map),
        square_(square),
        fine_(std::max(
            2, static_cast<int>(std::ceil(std::sqrt(points_a_texel * square.texels() /
                                                    (static_cast<double>(map.width) * map.height)))))) {}

  // Adds radiance x solid angle of a row of the map to the texels of the square.
  void add_row(int row, std::vector<glm::dvec3>& sums) const {
    const int w = map_.width;
    for (int j = 0; j < fine_; ++j) {
      const double step = pi / (static_cast<double>(map_.height) * fine_);
      const double top = std::cos((row * fine_ + j) * step), bottom = std::cos((row * fine_ + j + 1) * step);
      const double weight = (top - bottom) * 2.0 * pi / (static_cast<double>(w) * fine_);
      const Tap y = tap(j, fine_);
      const int other_row = std::clamp(row + y.neighbour, 0, map_.height - 1);
      for (int column = 0; column < w; ++column)
        for (int i = 0; i < fine_; ++i) {
          const Tap x = tap(i, fine_);
          const int other = (column + x.neighbour + w) % w;
          const glm::dvec3 here = glm::mix(texel(column, row), texel(other, row), x.weight),
                           there = glm::mix(texel(column, other_row), texel(other, other_row), x.weight);
          const double u = (column + (i + 0.5) / fine_) / w;
          const double azimuth = 2.0 * pi * (u - 0.5) - static_cast<double>(map_.rotation_y);
          sums[square_.texel_of(0.5 * (top + bottom), azimuth)] += weight * glm::mix(here, there, y.weight);
        }
    }
  }

 private:
  glm::dvec3 texel(int column, int row) const {
    return glm::dvec3(map_.texels[static_cast<size_t>(row) * static_cast<size_t>(map_.width) +
                                  static_cast<size_t>(column)]);
  }
  const Environment& map_;
  const EnvironmentSquare& square_;
  int fine_;
};

}  // namespace

EnvironmentSquare::EnvironmentSquare(int64_t texels) {
  if (!wavelet::is_power_of_four(texels) || texels < 4 || texels > most_texels)
    fail("environment_samples: {}; valid: powers of four from 4 to {}", texels, most_texels);
  side_ = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(texels))));
}

glm::dvec3 EnvironmentSquare::direction(uint32_t texel, const glm::dvec2& place) const {
  const double u = 2.0 * (gather_bits(texel) + place.x) / side_ - 1.0;
  const double v = 2.0 * (gather_bits(texel >> 1) + place.y) / side_ - 1.0;
  const double from_diamond = 1.0 - (std::abs(u) + std::abs(v)), r = 1.0 - std::abs(from_diamond);
  const double y = std::copysign(1.0 - r * r, from_diamond), sine = r * std::sqrt(std::max(0.0, 2.0 - r * r));
  // Share of the quadrant; in the corners |u| and |v| have changed places and sides.
  const double share = r > 0.0 ? 0.5 * ((std::abs(v) - std::abs(u)) / r + 1.0) : 0.0;
  const double ahead = std::copysign(sine * std::cos(0.5 * pi * share), u),
               aside = std::copysign(sine * std::sin(0.5 * pi * share), v);
  return {aside, y, -ahead};
}

uint32_t EnvironmentSquare::texel_of(const glm::vec3& d) const {
  return texel_of(static_cast<double>(d.y), std::atan2(static_cast<double>(d.x), -static_cast<double>(d.z)));
}

uint32_t EnvironmentSquare::texel_of(double y, double azimuth) const {
  const double turns = azimuth / (0.5 * pi), quadrant = std::floor(turns);
  const int q = static_cast<int>(quadrant) & 3;
  const double rising = turns - quadrant, share = q % 2 == 0 ? rising : 1.0 - rising;
  const double r = std::sqrt(std::max(0.0, 1.0 - std::abs(y)));
  double u = r * (1.0 - share), v = r * share;
  if (y < 0.0) {
    const double mirrored = 1.0 - v;
    v = 1.0 - u, u = mirrored;
  }
  if (q == 1 || q == 2) u = -u;
  if (q >= 2) v = -v;
  return spread_bits(cell(0.5 * (u + 1.0), side_)) | spread_bits(cell(0.5 * (v + 1.0), side_)) << 1;
}

std::vector<glm::dvec3> mean_radiance(const Environment& environment, const EnvironmentSquare& square) {
  if (environment.texels.empty())
    return std::vector<glm::dvec3>(square.texels(), glm::dvec3(environment.radiance));
  const MapSum map(environment, square);
  const auto rows = static_cast<size_t>(environment.height);
  std::array<std::vector<glm::dvec3>, parts> sums;
  tbb::parallel_for(size_t{0}, parts, [&](size_t part) {
    sums[part].assign(square.texels(), glm::dvec3(0.0));
    for (size_t row = part * rows / parts; row < (part + 1) * rows / parts; ++row)
      map.add_row(static_cast<int>(row), sums[part]);
  });
  std::vector<glm::dvec3> means(square.texels(), glm::dvec3(0.0));
  const glm::dvec3 factor = glm::dvec3(environment.radiance) / square.solid_angle();
  for (const auto& part : sums)
    for (size_t i = 0; i < means.size(); ++i) means[i] += factor * part[i];
  return means;
}

std::vector<glm::dvec3> radiance_pyramid(const std::vector<glm::dvec3>& texels) {
  std::vector<glm::dvec3> level = texels, pyramid = texels;
  while (level.size() > 1) {
    std::vector<glm::dvec3> above(level.size() / 4);
    for (size_t i = 0; i < above.size(); ++i)
      above[i] = 0.25 * ((level[4 * i] + level[4 * i + 1]) + (level[4 * i + 2] + level[4 * i + 3]));
    pyramid.insert(pyramid.begin(), above.begin(), above.end());
    level = std::move(above);
  }
  return pyramid;
}

bool same_environment(const Environment& a, const Environment& b) {
  return a.radiance == b.radiance && a.rotation_y == b.rotation_y && a.width == b.width &&
         a.height == b.height && a.texels == b.texels;
}

}  // namespace relight
