// Direct light on 16 samples at a time. The light models and reflection models are the shared sources
// (common/lights, common/brdf), inlined into loops over lanes that the compiler turns into AVX2; CMakeLists
// gives block_shading.cpp the options that this takes, none of which changes a value.
#pragma once

#include <cstdint>

#include "common/shading/direct_lighting.h"
#include "common/shading/sample_blocks.h"

namespace relight {

// One bit a lane.
using LaneMask = uint32_t;

// Lanes whose unshadowed irradiance is not black.
LaneMask lit_lanes(const Emitter& light, const SampleBlock& block);

// out = radiance that the lanes in `visible` reflect of the light [W/(m^2 sr)], black in the others; equal
// bit by bit to what shade_direct_cpu gives for one light. Returns the lanes whose radiance is not finite;
// they are black in `out`.
LaneMask reflected(const Emitter& light, const SampleBlocks& blocks, size_t block, Lobes lobes,
                   LaneMask visible, BlockRgb& out);

}  // namespace relight
