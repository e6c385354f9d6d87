// Shadows by ray tracing: the exact alternative to shadow maps.
#pragma once

#include <cstdint>
#include <vector>

#include "common/lights/light.h"
#include "common/sampling/surface_sample.h"

namespace relight {

class RayTracer;

// One bit a sample, bit i % 32 of word i / 32: 1 if the light lights sample i and nothing stands between
// them. Samples that the light cannot light (behind, outside the cone, invalid) cost no ray and get 0. Adds
// the rays to `rays`. Parallel; the result does not depend on the number of threads.
std::vector<uint32_t> traced_visibility(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const Light& light, int64_t& rays);

}  // namespace relight
