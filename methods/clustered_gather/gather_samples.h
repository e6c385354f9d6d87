// Gather samples of each view cluster: points that its hemisphere sees, found by quasi-Monte Carlo rays and
// reduced to a few clusters at once, so that the full set is never in memory (clustered gather paper, 2006,
// sections 3.1 to 3.3, equations 2 and 3).
//
// Directions follow the cosine to the view cluster's normal, so that a direction that hits weighs 1 /
// directions: irradiance / pi = sum of weight x radiance leaving the point. Directions that hit nothing, or
// that start below the geometric surface, count as black.
#pragma once

#include <cstdint>
#include <vector>

#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/tracing/ray_tracer.h"
#include "methods/clustered_gather/clustering.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

// Samples first[k] .. first[k + 1] - 1 belong to view cluster k. Their diffuse albedo is multiplied by their
// weight, as in the paper: the sum of the radiance that leaves them is irradiance / pi of the view cluster.
struct GatherSamples {
  std::vector<SurfaceSample> samples;
  std::vector<uint32_t> first;  // view clusters + 1
};

struct GatherSettings {
  int directions = 2000;
  size_t clusters = 120;  // gather samples kept of each; 0: all
  ClusteringStart start = ClusteringStart::hierarchical;
  int iterations = 5;
  uint64_t seed = 1;
};

// Logs counters gather_rays, gather_points (rays that hit) and gather_samples.
// Parallel, deterministic.
GatherSamples make_gather_samples(const RayTracer& tracer, const ViewClusters& view, const Metric6& metric,
                                  const GatherSettings& settings, Progress& progress, StageLog& log);

}  // namespace relight::clustered_gather
