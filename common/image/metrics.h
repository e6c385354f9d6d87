// Error metrics between an approximation A and a reference R, each with the value expected from the
// reference's own noise (DESIGN: never a number without its floor). Formulas stand beside the fields.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace relight {

struct MetricSet {
  double relative = 0;  // |A-R|_2 / |R|_2, A and R x exposure clamped to [0,1] (Hasan 2006 section 3.7)
  double relative_edges_out = 0;  // the same without edge pixels
  double relative_hdr = 0;        // without exposure and clamping
  double rmse = 0;                // sqrt(mean (A-R)^2) over pixels and channels
  double relmse = 0;              // mean (A-R)^2 / (R^2 + 0.01)
  double bias = 0;                // mean(A - R) / mean(R), signed
  double ssim = 0;  // mean structural similarity of luminance after exposure and clamp; 1 = equal
  double max = 0;   // largest |A-R| of any channel
};

// The reference is R = true image + noise. Model of the noise: Gaussian, independent between pixels, and
// within one pixel n_c = sigma_c z with one z for all channels (the same paths carry red, green and blue).
// Where the exposed value is clamped its noise is taken as 0 (first order: the slope of the clamp).
struct ErrorReport {
  MetricSet value;
  // What each metric would be on average if A were the noise-free image: a measured value near its floor says
  // nothing about A. With s_p = sum_c sigma_c^2 of pixel p (after exposure and clamp where the metric has
  // them):
  //   relative*, rmse  E sqrt(sum s_p z_p^2) over the metric's denominator; the sum as a scaled chi-square
  //   relmse           mean v f(R) + v^2 f''(R), f(R) = 1 / (R^2 + 0.01), v = sigma^2 (Stein's lemma)
  //   bias             E |bias| = sqrt(2/pi) sd(bias): the signed mean would be 0 and hide the noise
  //   ssim             expected ssim, below 1; each window's moments replaced by their expectations
  //   max              E max_p max_c sigma_pc |z_p|
  MetricSet noise_floor;
  // Half width of the 95 % confidence interval of each metric due to the reference's noise: 1.96 standard
  // deviations, propagated to first order plus the chi-square spread of the summed squared noise.
  MetricSet half_width;
  double edge_share = 0;   // share of pixels left out by relative_edges_out
  int64_t non_finite = 0;  // pixels of A or R with NaN or infinity: > 0 makes every metric NaN
};

// variance: per-channel variance of R's mean (may be empty: floor 0). A negative or non-finite variance makes
// every floor and half width NaN. edge: one byte a pixel, not 0 = edge (may be empty). Throws Error if sizes
// differ or there are no pixels. All-black R: relative, relative_hdr and bias are 0 if A is black too,
// infinity otherwise. relative_edges_out is NaN if every pixel is an edge.
ErrorReport compare_images(const Image& a, const Image& r, const Image& variance,
                           const std::vector<uint8_t>& edge, float exposure);

}  // namespace relight
