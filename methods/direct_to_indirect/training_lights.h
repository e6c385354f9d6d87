// Random lights that a row of the final-gather matrix should answer well, and what each wavelet coefficient
// sees of them. Not in the paper; see light_refit.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"

namespace relight::direct_to_indirect {

struct TrainingLights {
  uint32_t count = 0;           // 0: none
  std::vector<float> response;  // response[k * count + t]: wavelet coefficient k of light t's direct light
};

// `count` lights at random places in the space that the view samples see: three spots of 8 to 48 degrees in
// random directions for each omni. Direct light (traced shadows, channels averaged) on the ordered cloud,
// multiplied by column_scale where there is one, transformed to Haar; each light scaled so that its root mean
// square over the cloud is 1. Lights that reach no gather sample are replaced; fewer than `count` are
// returned if hardly any does. Deterministic.
TrainingLights make_training_lights(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const GatherCloud& ordered_cloud, std::span<const float> column_scale,
                                    uint32_t count, uint64_t seed);

}  // namespace relight::direct_to_indirect
