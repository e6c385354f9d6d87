#include "experiments/stored_references/brightness.h"

#include <algorithm>
#include <cmath>

namespace relight {

namespace {

// A tile this many times as noisy as those around it would drown them: from here on its own variance counts.
constexpr double much_noisier = 4.0;

// Sum of independent measured means times weights.
class WeightedSum {
 public:
  void add(double weight, const MeasuredMean& value) {
    const double variance = weight * weight * value.variance;
    mean_ += weight * value.mean, variance_ += variance;
    spread_ += variance * variance / (value.count - 1);
  }
  // The degrees of freedom of a sum are Welch and Satterthwaite's.
  MeasuredMean measured() const {
    const double freedom = spread_ > 0.0 ? std::min(variance_ * variance_ / spread_, 1e6) : 1e6;
    return {mean_, variance_, 1 + static_cast<int>(std::max(1.0, freedom))};
  }

 private:
  double mean_ = 0.0, variance_ = 0.0, spread_ = 0.0;
};

MeasuredMean of_tile(const PictureStatistics& p, int x, int y) {
  return {mean_channel(p.tiles.mean.at(x, y)), variance_of_mean_channel(p.tiles.variance.at(x, y)),
          p.batches};
}

double weight_of(const PictureStatistics& stored, int x, int y) {
  const Image& tiles = stored.tiles.mean;
  double mean = 0.0, variance = 0.0;
  int count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, tiles.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, tiles.width - 1); ++u) {
      if (u == x && v == y) continue;
      const MeasuredMean tile = of_tile(stored, u, v);
      mean += tile.mean, variance += tile.variance, ++count;
    }
  variance = std::max(variance, count * of_tile(stored, x, y).variance / much_noisier);
  return variance > 0.0 ? mean / variance : 0.0;
}

}  // namespace

double mean_channel(const glm::vec3& v) {
  return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3.0;
}

double variance_of_mean_channel(const glm::vec3& v) {
  const double sum = std::sqrt(static_cast<double>(v.x)) + std::sqrt(static_cast<double>(v.y)) +
                     std::sqrt(static_cast<double>(v.z));
  return sum * sum / 9.0;
}

void floor_variances(MeasuredMean& fresh, MeasuredMean& stored, const PictureStatistics& f,
                     const PictureStatistics& s) {
  const double ratio = static_cast<double>(s.samples_per_pixel) / static_cast<double>(f.samples_per_pixel);
  const double of_fresh = fresh.variance;
  fresh.variance = std::max(fresh.variance, stored.variance * ratio);
  stored.variance = std::max(stored.variance, of_fresh / ratio);
}

std::pair<MeasuredMean, MeasuredMean> weighted_brightness(const PictureStatistics& fresh,
                                                          const PictureStatistics& stored) {
  WeightedSum now, before;
  for (int y = 0; y < stored.tiles.mean.height; ++y)
    for (int x = 0; x < stored.tiles.mean.width; ++x) {
      const double weight = weight_of(stored, x, y);
      MeasuredMean f = of_tile(fresh, x, y), s = of_tile(stored, x, y);
      floor_variances(f, s, fresh, stored);
      now.add(weight, f), before.add(weight, s);
    }
  return {now.measured(), before.measured()};
}

}  // namespace relight
