#include "common/image/noise_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace relight {

namespace {

struct SigmaClass {
  double count = 0, sum_of_squares = 0;
};

// Sigmas within 1/16 octave count as one, their root mean square: 4 % apart at most, and the image's 10^5
// pixels become some hundred classes.
std::vector<std::pair<double, double>> sigma_classes(const std::vector<double>& sigmas) {
  std::map<long, SigmaClass> classes;
  for (const double sigma : sigmas) {
    if (sigma <= 0.0) continue;
    SigmaClass& bin = classes[std::lround(std::floor(16.0 * std::log2(sigma)))];
    bin.count += 1.0;
    bin.sum_of_squares += sigma * sigma;
  }
  std::vector<std::pair<double, double>> result;
  for (const auto& [index, bin] : classes)
    result.emplace_back(std::sqrt(bin.sum_of_squares / bin.count), bin.count);
  return result;
}

}  // namespace

double expected_norm(double sum, double sum_of_squares) {
  if (!(sum_of_squares > 0.0)) return sum == 0.0 ? 0.0 : std::sqrt(sum);
  const double k = sum * sum / sum_of_squares;
  // Beyond this the ratio of gamma functions is 1 - 1/(4k), and their logarithms would cancel badly.
  if (k > 1e6) return std::sqrt(sum) * (1.0 - 0.25 / k);
  return std::sqrt(sum * 2.0 / k) * std::exp(std::lgamma(0.5 * (k + 1.0)) - std::lgamma(0.5 * k));
}

double expected_maximum(const std::vector<double>& sigmas) {
  const auto classes = sigma_classes(sigmas);
  if (classes.empty()) return 0.0;
  const double largest = classes.back().first;
  // 10 sigma: the chance that any of 10^9 values lies beyond is 10^-14. Midpoint rule.
  constexpr int steps = 500;
  const double step = 10.0 * largest / steps;
  double integral = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) * step;
    double log_all_below = 0.0;
    for (const auto& [sigma, count] : classes)
      log_all_below += count * std::log1p(-std::erfc(t / (sigma * std::sqrt(2.0))));
    integral += step * -std::expm1(log_all_below);
  }
  return integral;
}

double root_half_width(double q, double variance) {
  const double reach = normal_quantile_95 * std::sqrt(variance);
  return 0.5 * (std::sqrt(q + reach) - std::sqrt(std::max(q - reach, 0.0)));
}

}  // namespace relight
