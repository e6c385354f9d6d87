// Phase one of the clustering: repeated two-way splits of the cluster with the largest total distance.
#pragma once

#include <span>
#include <vector>

#include "methods/clustered_gather/points6.h"

namespace relight::clustered_gather {

// Centres of at most `clusters` groups of points. Points that are all alike are not split.
std::vector<Point6> hierarchical_centres(std::span<const Point6> points, size_t clusters, int iterations);

}  // namespace relight::clustered_gather
