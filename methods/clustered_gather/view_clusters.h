// Clustered view samples: where indirect light is computed, and how pixels interpolate it (Hasan, Pellacini,
// Bala 2005, sections 3.3 and 3.3.2, equation 3).
#pragma once

#include <cstdint>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "methods/clustered_gather/clustering.h"

namespace relight::clustered_gather {

// One row of a view: for each pixel the same number of links, those that are not needed with weight 0.
struct Links {
  uint32_t per_pixel = 0;
  std::vector<uint32_t> cluster;  // per_pixel a pixel
  std::vector<float> weight;      // >= 0; of a pixel with a view sample they sum to 1, else all are 0
};

struct ViewClusters {
  // Position: of the member closest to the mean position, so that visibility is that of a surface. Normals:
  // the mean of the members', or the member's own where the mean is zero or points behind its surface.
  std::vector<SurfaceSample> samples;
  std::vector<Point6> centres;
};

// Clusters the valid view samples, one a pixel. clusters = 0, or no less than there are: each is its own.
ViewClusters cluster_view(const DeepFrameBuffer& buffer, const Metric6& metric,
                          const ClusteringSettings& settings);

// Links of each pixel to its `neighbours` nearest clusters. The weights are radial basis functions
// (1 - d / R)^2 of the distance d in the metric, R just beyond the farthest; clusters whose normal differs by
// more than 45 degrees are left out unless there are no others, so that light does not leak around edges.
// Parallel, deterministic.
Links link_pixels(const DeepFrameBuffer& buffer, const ViewClusters& clusters, const Metric6& metric,
                  int neighbours);

}  // namespace relight::clustered_gather
