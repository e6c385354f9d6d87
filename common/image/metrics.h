// Error metrics between an approximation A and a reference R, each with the value expected from the reference's own
// noise (DESIGN: never a number without its floor). Formulas stand beside the fields.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace relight {

struct MetricSet {
  double relative = 0;            // |A-R|_2 / |R|_2, A and R x exposure clamped to [0,1] (Hasan 2006 section 3.7)
  double relative_edges_out = 0;  // the same without edge pixels
  double relative_hdr = 0;        // without exposure and clamping
  double rmse = 0;                // sqrt(mean (A-R)^2) over pixels and channels
  double relmse = 0;              // mean (A-R)^2 / (R^2 + 0.01)
  double bias = 0;                // mean(A - R) / mean(R), signed
  double ssim = 0;                // mean structural similarity of luminance after exposure and clamp; 1 = equal
  double max = 0;                 // largest |A-R| of any channel
};

struct ErrorReport {
  MetricSet value;
  MetricSet noise_floor;  // expectation of each metric for A = the noise-free image (ssim: 1 - loss)
  MetricSet half_width;   // half width of the 95 % confidence interval of each metric due to the reference's noise
  double edge_share = 0;  // share of pixels left out by relative_edges_out
  int64_t non_finite = 0; // pixels of A or R with NaN or infinity: > 0 makes every metric NaN
};

// variance: per-channel variance of R's mean (may be empty: floor 0). edge: one byte a pixel (may be empty).
// Throws Error if sizes differ. All-black R: relative = 0 if A is black too, infinity otherwise.
ErrorReport compare_images(const Image& a, const Image& r, const Image& variance, const std::vector<uint8_t>& edge,
                           float exposure);

}  // namespace relight
