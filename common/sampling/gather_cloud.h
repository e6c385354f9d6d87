// The gather cloud: points spread over the scene's surfaces on which direct light is computed (Hasan 2006
// section 4.1, uniform sampling; GPU Gems 3 chapter 9, listing 9-1).
#pragma once

#include <cstdint>
#include <vector>

#include "common/run/stage_log.h"
#include "common/sampling/live_sides.h"
#include "common/sampling/surface_sample.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

struct GatherCloud {
  std::vector<SurfaceSample> samples;
  std::vector<float>
      area;  // surface area each sample stands for [scene units^2]; they sum to the sampled sides' area
};

// Uniform divide and conquer: the set of triangle sides is split by an axis-aligned plane into two halves of
// about equal area and the budget in proportion, until one side (sampled by a low-discrepancy sequence) or a
// budget of one (a side picked by area, a point on it) is left. The expected number of samples is
// proportional to area. A surface with two live sides is sampled on both. Returns exactly `budget` samples.
// Throws Error if nothing has area. Does not do: importance sampling (section 4.1, last paragraphs).
GatherCloud make_uniform_gather_cloud(const RayTracer& tracer, const LiveSides& live, int64_t budget,
                                      uint64_t seed);

}  // namespace relight
