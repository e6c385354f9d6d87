// How values that are not finite are reported, in the same words by the GPU and the CPU: counted and warned
// of in a release build, an Error in a debug build. The caller has replaced them by zero.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/run/stage_log.h"

namespace relight {

// Counter non_finite_direct_shading. first: smallest index of a sample concerned.
void report_non_finite_shading(int64_t count, uint32_t first, StageLog& log);

// Counter non_finite_reconstruction. which: "direct" or "indirect"; first: row-major number of the first
// pixel.
void report_non_finite_pixels(const char* which, int64_t count, size_t first, size_t width, StageLog& log);

}  // namespace relight
