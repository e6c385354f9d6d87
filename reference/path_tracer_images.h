// From the path tracer's statistics to images.
#pragma once

#include "reference/direct_image.h"
#include "reference/path_tracer.h"
#include "reference/path_tracer_state.h"

namespace relight {

// |standard error of the mean| / |mean + direct| over all pixels and channels; 0 before the second batch.
double relative_standard_error(const PathTracerState& state, const Image& direct);
// Fills indirect, its variance and the number of fireflies; result.direct gives the size.
void write_indirect(const PathTracerState& state, bool with_variance, PathTracerResult& result);
// Fills result.layers: exact ones that are not black, then one for each class.
void write_layers(const PathTracerState& state, const PathClasses& classes, const DirectImage& direct,
                  PathTracerResult& result);

}  // namespace relight
