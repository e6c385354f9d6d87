// Probabilities that the tests of pictures need.
#pragma once

namespace relight {

// A mean with the variance of that mean, estimated from `count` independent values.
struct MeasuredMean {
  double mean = 0.0, variance = 0.0;
  int count = 2;
};

// Two-sided p-value of "both means estimate the same number": Student's t with the degrees of freedom of
// Welch 1947, (v1 + v2)^2 / (v1^2 / (n1 - 1) + v2^2 / (n2 - 1)). Stored numbers are rounded, so differences
// of 1e-5 are added to the variance; where there is no noise at all the p-value is 1 or 0.
double welch_p_value(const MeasuredMean& a, const MeasuredMean& b);

// The standard normal deviate that is as unlikely: the difference in standard errors, Welch-corrected, for
// people. >= 0.
double equivalent_sigmas(double p_value);

// P(X >= count), X binomial.
double binomial_upper_tail(int count, int trials, double probability);

// p-value of the smallest of `tests` independent p-values, 1 - (1 - p)^tests (Sidak 1967). For positively
// dependent ones it is an upper bound.
double sidak_p_value(double smallest, int tests);

// The level for each of `tests` tests that gives `level` together.
double sidak_level(double level, int tests);

}  // namespace relight
