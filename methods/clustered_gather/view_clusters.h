// Clustered view samples: where indirect light is computed, and how pixels interpolate it (Hasan, Pellacini,
// Bala 2005, sections 3.3 and 3.3.2, equation 3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "methods/clustered_gather/clustering.h"

namespace relight::clustered_gather {

// Which of the two reflections a set of view clusters is for: each has its own (section 3.3.2).
enum class Part { diffuse, glossy };

// The view's pixels that have this part, ascending: those with a view sample, or with a glossy one.
std::vector<uint32_t> pixels_with(const DeepFrameBuffer& buffer, Part part);

// View clusters for the diffuse and the glossy part, in the ratio of the energy seen through the camera: the
// sums over the pixels of the luminance of both albedos. A part that is there gets at least one. clusters =
// 0: 0 for both, which means all.
struct Split {
  size_t diffuse = 0, glossy = 0;
};
Split split_by_energy(const DeepFrameBuffer& buffer, size_t clusters);

// For each listed pixel the same number of links; those that are not needed have weight 0.
struct Links {
  uint32_t per_pixel = 0;
  std::vector<uint32_t> pixel;    // index into the picture
  std::vector<uint32_t> cluster;  // per_pixel for each
  std::vector<float> weight;      // likewise; >= 0, those of a pixel sum to 1
};

struct ViewClusters {
  // Position: of the member closest to the mean position, so that visibility is that of a surface. Normals:
  // the mean of the members', or the member's own where the mean is zero or points behind its surface.
  std::vector<SurfaceSample> samples;
  std::vector<Point6> centres;
};

// Clusters the view samples of these pixels. clusters = 0, or no less than there are: each is its own.
ViewClusters cluster_view(const DeepFrameBuffer& buffer, std::span<const uint32_t> pixels,
                          const Metric6& metric, const ClusteringSettings& settings);

// Links of each pixel to its `neighbours` nearest clusters. The weights are radial basis functions
// (1 - d / R)^2 of the distance d in the metric, R just beyond the farthest; clusters whose normal differs by
// more than 45 degrees are left out unless there are no others, so that light does not leak around edges. For
// the glossy part so are those of another material, whose highlights are of another kind. Parallel,
// deterministic.
Links link_pixels(const DeepFrameBuffer& buffer, std::vector<uint32_t> pixels, Part part,
                  const ViewClusters& clusters, const Metric6& metric, int neighbours);

}  // namespace relight::clustered_gather
