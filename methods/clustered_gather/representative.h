// What stands for the members of a cluster: the paper's averages, and the place of the member in the middle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/surface_sample.h"

namespace relight::clustered_gather {

// A copy of the member closest (in 3-D) to the mean position, with the mean shading normal of all. Where that
// mean vanishes, or lies behind the member's own surface, the member's normal stays: there a light that the
// member could not see would shine on the average. members: indices into samples, at least one.
SurfaceSample representative(std::span<const SurfaceSample> samples, std::span<const uint32_t> members);

// The members of each cluster, in order: members of cluster k are list[start[k]] .. list[start[k + 1] - 1].
struct Members {
  std::vector<uint32_t> start, list;
  std::span<const uint32_t> of(size_t cluster) const {
    return std::span(list).subspan(start[cluster], start[cluster + 1] - start[cluster]);
  }
};
Members members_of(std::span<const uint32_t> cluster_of, size_t clusters);

}  // namespace relight::clustered_gather
