// Structural similarity. This work is based on: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment:
// From Error Visibility to Structural Similarity", 2004.
#pragma once

#include <vector>

namespace relight {

// One number a pixel, row-major.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;
};

struct SsimReport {
  double value = 1;        // mean over all pixels of equation 13 of the paper
  double noise_floor = 1;  // expected value if x were y without its noise
  double half_width = 0;   // 95 %, first order
};

// x, y: luminance in [0,1] (dynamic range L = 1), the same size; y_variance: variance of y's noise,
// independent between pixels. Gaussian window 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03; at the border the
// part of the window inside the image is normalised to 1, so that every size down to one pixel has an answer.
SsimReport structural_similarity(const Plane& x, const Plane& y, const Plane& y_variance);

}  // namespace relight
