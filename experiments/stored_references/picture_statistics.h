// A picture as the mean of independent renders, and how sure it is at three levels: pixels, tiles, and the
// whole picture. Pixels of a 4x4 tile share light vertices, so their errors are correlated and the variance
// of a tile's mean does not follow from those of its pixels; it is measured from the spread of the renders.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"
#include "common/run/progress.h"
#include "reference/path_tracer.h"

namespace relight {

inline constexpr int tile_side = 4;  // pixels; that of the path tracer

// Mean of the renders and variance of that mean, per channel.
struct Estimate {
  Image mean, variance;
};

struct PictureStatistics {
  Image direct;               // exact
  Estimate pixels;            // indirect light, WxH
  Estimate tiles;             // of the means of 4x4 pixels
  Estimate whole;             // of the mean of all pixels, 1x1
  int batches = 0;            // independent renders: variances have batches - 1 degrees of freedom
  int samples_per_pixel = 0;  // of all batches together
  int64_t non_finite = 0, fireflies = 0, rays = 0;  // see PathTracerResult
  double seconds = 0.0;

  // |standard error of the mean|_2 / |direct + indirect|_2 over all pixels.
  double relative_standard_error() const;
};

// Means of side x side blocks of pixels; blocks at the right and lower border may be smaller.
Image block_means(const Image& image, int side);

struct BatchPlan {
  LightPaths paths;
  Estimator estimator = Estimator::light_vertex;
  int batches = 32;           // >= 2
  int samples_per_batch = 4;  // a pixel
  uint64_t seed = 1;          // plans of different seeds share no random numbers
};

// Statistics of independent pictures of indirect light, at least two of one size; all other fields stay as
// they are in an empty picture. Throws Error for fewer.
PictureStatistics statistics_of(const std::vector<Image>& renders);

// Renders `batches` times with seeds of their own, each a single scrambled Sobol sequence. Same bits for any
// number of threads. Throws Error for settings out of range.
PictureStatistics render_statistics(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const LightingState& lighting, const BatchPlan& plan, Progress& progress);

}  // namespace relight
