#include "reference/environment_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/image/luminance.h"

namespace relight {
namespace {

constexpr double pi = std::numbers::pi;

// Index of the interval of a cumulative distribution that holds u, and where in it u lies, in [0,1).
size_t find(const double* cumulative, size_t count, double u, double& inside) {
  const double* found = std::upper_bound(cumulative, cumulative + count - 1, u);
  // An interval without width is never hit from inside, but rounding may end on one.
  while (found > cumulative && *found == *(found - 1)) --found;
  const double low = found == cumulative ? 0.0 : *(found - 1), width = *found - low;
  inside = width > 0.0 ? std::clamp((u - low) / width, 0.0, 1.0 - 0x1p-40) : 0.5;
  return static_cast<size_t>(found - cumulative);
}

}  // namespace

// A texel's share is the mean of the lookup over it: bilinear interpolation spreads a texel over its
// neighbours with weights 1/8, 6/8, 1/8 along each axis. Without that, the rim of a sun between dark texels
// would shine where nothing is ever sampled.
EnvironmentSampler::EnvironmentSampler(const Environment& environment) : environment_(environment) {
  if (environment.texels.empty() || environment.black()) return;
  const int w = environment.width, h = environment.height;
  const auto texel = [&](int x, int y) {
    const size_t row = static_cast<size_t>(std::clamp(y, 0, h - 1)) * static_cast<size_t>(w);
    return luminance(
        glm::dvec3(environment.radiance * environment.texels[row + static_cast<size_t>((x + w) % w)]));
  };
  constexpr double tap[3] = {0.125, 0.75, 0.125};
  std::vector<double> rows, columns;
  double total = 0.0;
  for (int y = 0; y < h; ++y) {
    // Solid angle of the row's texels, exactly.
    const double solid_angle = (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h)) * 2.0 * pi / w;
    double row = 0.0;
    for (int x = 0; x < w; ++x) {
      double value = 0.0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) value += tap[dx + 1] * tap[dy + 1] * texel(x + dx, y + dy);
      columns.push_back(row += value);
    }
    for (auto c = columns.end() - w; row > 0.0 && c != columns.end(); ++c) *c /= row;
    rows.push_back(total += row * solid_angle);
  }
  if (!(total > 0.0)) return;
  for (double& r : rows) r /= total;
  width_ = w, height_ = h;
  rows_ = std::move(rows), columns_ = std::move(columns);
}

double EnvironmentSampler::probability(int column, int row) const {
  const auto r = static_cast<size_t>(row), c = static_cast<size_t>(column), w = static_cast<size_t>(width_);
  const double in_rows = rows_[r] - (r > 0 ? rows_[r - 1] : 0.0);
  return in_rows * (columns_[r * w + c] - (c > 0 ? columns_[r * w + c - 1] : 0.0));
}

float EnvironmentSampler::texel_pdf(int column, int row) const {
  const double solid_angle =
      (std::cos(pi * row / height_) - std::cos(pi * (row + 1) / height_)) * 2.0 * pi / width_;
  return static_cast<float>(probability(column, row) / solid_angle);
}

EnvironmentSample EnvironmentSampler::sample(const glm::vec2& u) const {
  EnvironmentSample sample;
  if (empty()) return sample;
  double y_inside = 0.0, x_inside = 0.0;
  const size_t row = find(rows_.data(), rows_.size(), static_cast<double>(u.y), y_inside);
  const size_t column = find(columns_.data() + row * static_cast<size_t>(width_), static_cast<size_t>(width_),
                             static_cast<double>(u.x), x_inside);
  // Uniform in solid angle within the texel: cos(theta) is linear in u.
  const double top = std::cos(pi * static_cast<double>(row) / height_),
               bottom = std::cos(pi * static_cast<double>(row + 1) / height_);
  const double y = top + y_inside * (bottom - top), sine = std::sqrt(std::max(0.0, 1.0 - y * y));
  // The inverse of Environment::lookup: u = 1/2 + (azimuth + rotation)/(2 pi), azimuth = atan2(x, -z).
  const double azimuth = 2.0 * pi * ((static_cast<double>(column) + x_inside) / width_ - 0.5) -
                         static_cast<double>(environment_.rotation_y);
  sample.direction = glm::vec3(glm::dvec3(sine * std::sin(azimuth), y, -sine * std::cos(azimuth)));
  sample.pdf = texel_pdf(static_cast<int>(column), static_cast<int>(row));
  return sample;
}

float EnvironmentSampler::pdf(const glm::vec3& d) const {
  if (empty()) return 0.0f;
  const double azimuth = std::atan2(static_cast<double>(d.x), -static_cast<double>(d.z)) +
                         static_cast<double>(environment_.rotation_y);
  double u = 0.5 + azimuth / (2.0 * pi);
  u -= std::floor(u);
  const double v = std::acos(std::clamp(static_cast<double>(d.y), -1.0, 1.0)) / pi;
  const int column = std::min(static_cast<int>(u * width_), width_ - 1),
            row = std::min(static_cast<int>(v * height_), height_ - 1);
  return texel_pdf(column, row);
}

}  // namespace relight
