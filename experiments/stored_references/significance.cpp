#include "experiments/stored_references/significance.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace relight {

namespace {

constexpr double rounding = 1e-5;  // relative; sixteen bits of mantissa, and float sums

}  // namespace

double welch_p_value(const MeasuredMean& a, const MeasuredMean& b) {
  const double error = rounding * std::max(std::abs(a.mean), std::abs(b.mean));
  const double variance = a.variance + b.variance + error * error;
  const double difference = std::abs(a.mean - b.mean);
  if (!std::isfinite(difference) || !std::isfinite(variance)) return 0.0;
  if (variance <= 0.0) return difference > 0.0 ? 0.0 : 1.0;
  const double spread = a.variance * a.variance / (a.count - 1) + b.variance * b.variance / (b.count - 1);
  // Without measured noise only rounding is left, which has no tails.
  if (spread <= 0.0) return difference > 4.0 * error ? 0.0 : 1.0;
  const double freedom = std::min(variance * variance / spread, 1e6);
  const boost::math::students_t distribution(freedom);
  return 2.0 * boost::math::cdf(boost::math::complement(distribution, difference / std::sqrt(variance)));
}

double equivalent_sigmas(double p_value) {
  const double p = std::clamp(p_value, 1e-300, 1.0);
  return boost::math::quantile(boost::math::complement(boost::math::normal(), 0.5 * p));
}

double binomial_upper_tail(int count, int trials, double probability) {
  if (count <= 0) return 1.0;
  if (count > trials) return 0.0;
  return boost::math::cdf(boost::math::complement(boost::math::binomial(trials, probability), count - 1));
}

double sidak_p_value(double smallest, int tests) {
  return smallest >= 1.0 ? 1.0 : -std::expm1(tests * std::log1p(-smallest));
}

double sidak_level(double level, int tests) { return -std::expm1(std::log1p(-level) / tests); }

}  // namespace relight
