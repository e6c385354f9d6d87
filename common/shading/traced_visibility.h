// Shadows by ray tracing: the exact alternative to shadow maps.
#pragma once

#include <cstdint>
#include <vector>

#include "common/lights/emitter.h"
#include "common/sampling/surface_sample.h"

namespace relight {

class RayTracer;

// One bit a sample, bit i % 32 of word i / 32: 1 if the light lights sample i and nothing stands between
// them. Samples that the light cannot light (behind, outside the cone, invalid) cost no ray and get 0. Adds
// the rays to `rays`. Parallel; the result does not depend on the number of threads.
std::vector<uint32_t> traced_visibility(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const Emitter& light, int64_t& rays);

// The mask of the samples in `active`, at most 16, between which and the light nothing stands. origins: off
// their surfaces (RayTracer::offset_point).
uint32_t visible16(const RayTracer& tracer, const glm::vec3* origins, const Emitter& light, uint32_t active);

}  // namespace relight
