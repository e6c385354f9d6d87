// The gather cloud: points spread over the scene's surfaces on which direct light is computed (Hasan 2006
// section 4.1; GPU Gems 3 chapter 9, listing 9-1).
#pragma once

#include <cstdint>
#include <vector>

#include "common/sampling/importance_map.h"
#include "common/sampling/surface_pieces.h"
#include "common/sampling/surface_sample.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

struct GatherCloud {
  std::vector<SurfaceSample> samples;
  std::vector<float> area;  // surface area each sample stands for [scene units^2]: sum of f(sample) x area
                            // estimates the integral of f over the pieces
};

// Divide and conquer: the set of pieces is split by an axis-aligned plane into two halves of about equal
// weight (area x importance) and the budget in proportion, until one piece (sampled by a low-discrepancy
// sequence) or a budget of one (a piece picked by weight, a point on it) is left. With equal importances this
// is the paper's uniform sampling. Reorders `pieces`. Returns exactly `budget` samples. Throws Error if no
// piece has weight.
GatherCloud make_gather_cloud(const RayTracer& tracer, std::vector<SurfacePiece>& pieces, int64_t budget,
                              uint64_t seed);

enum class CloudSampling { uniform, importance };

// Gather cloud for a view. uniform: spread evenly over every surface that particles from the view reach;
// importance: in proportion to their density.
GatherCloud make_gather_cloud_for_view(const RayTracer& tracer, const CloudView& view, CloudSampling sampling,
                                       int64_t budget, uint64_t seed);

}  // namespace relight
