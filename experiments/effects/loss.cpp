#include "experiments/effects/loss.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/image/noise_statistics.h"
#include "common/run/error.h"

namespace relight {

namespace {

// Sums over replicates of one channel of one pixel: lost light l, whole light r, exposed.
struct Sums {
  double n = 0, l = 0, l2 = 0, r = 0, r2 = 0;
  void add(double lost, double whole) {
    n += 1, l += lost, l2 += lost * lost, r += whole, r2 += whole * whole;
  }
  Sums without(double lost, double whole) const {
    return {n - 1, l - lost, l2 - lost * lost, r - whole, r2 - whole * whole};
  }
};

struct Quotient {
  double numerator = 0, denominator = 0;
  void add(const Sums& s) {
    const double whole = s.r / s.n, excess = std::max(0.0, whole - 1.0);
    denominator += std::pow(std::min(1.0, whole), 2);
    if (whole < 1.0) denominator -= (s.r2 - s.r * whole) / (s.n * (s.n - 1.0));
    if (s.l == 0.0 || whole - s.l / s.n >= 1.0) return;
    const double sum = s.l - s.n * excess;
    const double squares = s.l2 - 2.0 * excess * s.l + s.n * excess * excess;
    numerator += (sum * sum - squares) / (s.n * (s.n - 1.0));
  }
  void operator+=(const Quotient& other) { numerator += other.numerator, denominator += other.denominator; }
  double value() const { return denominator > 0.0 ? numerator / denominator : numerator > 0.0 ? 1.0 : 0.0; }
};

double root(double square) { return std::sqrt(std::max(0.0, square)); }

// The quotient of all replicates, and without each of them.
struct Jackknife {
  explicit Jackknife(size_t replicates) : without(replicates) {}
  void add(const std::vector<double>& lost, const std::vector<double>& whole) {
    Sums sums;
    for (size_t k = 0; k < without.size(); ++k) sums.add(lost[k], whole[k]);
    all.add(sums);
    for (size_t k = 0; k < without.size(); ++k) without[k].add(sums.without(lost[k], whole[k]));
  }
  void operator+=(const Jackknife& other) {
    all += other.all;
    for (size_t k = 0; k < without.size(); ++k) without[k] += other.without[k];
  }
  LossInterval interval() const {
    const auto n = static_cast<double>(without.size());
    double mean = 0.0, spread = 0.0;
    for (const Quotient& q : without) mean += q.value() / n;
    for (const Quotient& q : without) spread += std::pow(q.value() - mean, 2);
    const double half_width =
        student_quantile_95(static_cast<int>(without.size()) - 1) * std::sqrt(spread * (n - 1.0) / n);
    return {root(all.value()), root(all.value() - half_width), root(all.value() + half_width)};
  }
  Quotient all;
  std::vector<Quotient> without;
};

constexpr size_t piece = 4096;  // pixels

}  // namespace

double student_quantile_95(int degrees_of_freedom) {
  // Cornish-Fisher expansion around the normal quantile.
  const double z = normal_quantile_95, v = degrees_of_freedom, z2 = z * z;
  return z + z * (z2 + 1) / (4 * v) + z * ((5 * z2 + 16) * z2 + 3) / (96 * v * v) +
         z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * v * v * v);
}

LossInterval sum_of(const LossInterval& a, const LossInterval& b) {
  return {a.value + b.value, a.low + b.low, a.high + b.high};
}

LossEstimator::LossEstimator(const LightByGroup& light, std::vector<uint8_t> everything, double exposure)
    : light_(light), exposure_(exposure) {
  if (light.replicates.size() < 3) fail("loss of light: {} replicates; at least 3", light.replicates.size());
  for (const std::vector<Image>& groups : light.replicates) {
    Image& whole = whole_.emplace_back(light.width, light.height);
    for (size_t g = 0; g < groups.size(); ++g)
      for (size_t i = 0; everything.at(g) && i < whole.pixels.size(); ++i)
        whole.pixels[i] += groups[g].pixels[i];
  }
}

// The chosen groups of each replicate, added up; empty if it has none of them.
std::vector<Image> LossEstimator::chosen_light(const std::vector<uint8_t>& groups) const {
  std::vector<Image> sums(whole_.size());
  for (size_t k = 0; k < sums.size(); ++k)
    for (size_t g = 0; g < light_.replicates[k].size(); ++g) {
      if (!groups.at(g)) continue;
      const Image& image = light_.replicates[k][g];
      if (sums[k].pixels.empty()) sums[k] = Image(image.width, image.height);
      for (size_t i = 0; i < image.pixels.size(); ++i) sums[k].pixels[i] += image.pixels[i];
    }
  return sums;
}

LossInterval LossEstimator::lost(const std::vector<uint8_t>& groups) const {
  const std::vector<Image> lost = chosen_light(groups);
  if (std::all_of(lost.begin(), lost.end(), [](const Image& i) { return i.pixels.empty(); })) return {};
  // Pieces of fixed size, added up in order: the same bits for any number of threads.
  const size_t pixels = whole_.front().pixels.size(), pieces = (pixels + piece - 1) / piece;
  std::vector<Jackknife> parts(pieces, Jackknife(whole_.size()));
  tbb::parallel_for(size_t{0}, pieces, [&](size_t p) {
    std::vector<double> l(whole_.size()), r(whole_.size());
    for (size_t i = p * piece; i < std::min(pixels, (p + 1) * piece); ++i)
      for (int c = 0; c < 3; ++c) {
        for (size_t k = 0; k < whole_.size(); ++k) {
          l[k] = lost[k].pixels.empty() ? 0.0 : exposure_ * static_cast<double>(lost[k].pixels[i][c]);
          r[k] = exposure_ * static_cast<double>(whole_[k].pixels[i][c]);
        }
        parts[p].add(l, r);
      }
  });
  for (size_t p = 1; p < pieces; ++p) parts[0] += parts[p];
  return parts[0].interval();
}

LossInterval LossEstimator::lost(const Image& lacking) const {
  double numerator = 0.0;
  Quotient all;
  for (size_t i = 0; i < lacking.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      Sums sums;
      for (const Image& whole : whole_) sums.add(0.0, exposure_ * static_cast<double>(whole.pixels[i][c]));
      all.add(sums);
      const double r = sums.r / sums.n, l = exposure_ * static_cast<double>(lacking.pixels[i][c]);
      numerator += std::pow(std::clamp(r, 0.0, 1.0) - std::clamp(r - l, 0.0, 1.0), 2);
    }
  all.numerator = numerator;
  const double value = root(all.value());
  return {value, value, value};
}

}  // namespace relight
