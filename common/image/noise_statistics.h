// Statistics of Gaussian noise that the error metrics need: expectations of norms and maxima, and interval
// widths.
#pragma once

#include <vector>

namespace relight {

// Two-sided 95 % quantile of the standard normal distribution.
inline constexpr double normal_quantile_95 = 1.959963984540054;

// E sqrt(sum_p s_p z_p^2) for independent standard normal z_p, given sum s_p and sum s_p^2. The sum is taken
// as a scaled chi-square with k = (sum s)^2 / sum s^2 degrees of freedom (Satterthwaite 1946), which is exact
// for equal s_p: sqrt(sum s) sqrt(2/k) Gamma((k+1)/2) / Gamma(k/2).
double expected_norm(double sum, double sum_of_squares);

// E max_p sigma_p |z_p| = integral over t > 0 of 1 - prod_p erf(t / (sigma_p sqrt 2)). Every sigma_p finite,
// >= 0.
double expected_maximum(const std::vector<double>& sigmas);

// Half width of the 95 % interval of sqrt(q) for an estimate q >= 0 of the given variance: half the distance
// between the roots of the interval's ends. Equal to 1.96 sd / (2 sqrt q) for small variances and finite at q
// = 0.
double root_half_width(double q, double variance);

}  // namespace relight
