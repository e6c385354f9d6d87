// Pictures of differences, in colours whose order the eye sees: dark is small, bright is large.
#pragma once

#include "common/image/image.h"

namespace relight {

// Colour of t in [0,1] (clamped) as linear RGB: matplotlib's viridis (van der Walt and Smith 2015, CC0) from
// ten of its colours, interpolated in sRGB. Lightness grows steadily with t. NaN and infinity are magenta,
// which is not on the scale.
glm::vec3 false_colour(double t);

// Mean over channels of |A-R| at every pixel, divided by full_scale > 0, in false colours (linear RGB: write
// with exposure 1). Throws Error if sizes differ.
Image difference_image(const Image& a, const Image& r, double full_scale);

// A full scale that one bright pixel can't spoil: the difference that 99 % of the pixels stay within, or the
// largest if that is 0. 0 for equal images; pixels with NaN or infinity are left out.
double difference_scale(const Image& a, const Image& r);

}  // namespace relight
