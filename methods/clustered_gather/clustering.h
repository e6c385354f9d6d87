// k-means clustering with the paper's two-phase start (clustered gather paper, 2006, section 3.3.1): the
// cluster with the largest total distance is split in two until there are enough, then k-means runs on all of
// them.
//
// Distances are squared, as the mean is the best centre for those. Deterministic: ties go to the smaller
// index, random starts depend on the seed alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/clustered_gather/points6.h"

namespace relight::clustered_gather {

enum class ClusteringStart { hierarchical, random };

struct ClusteringSettings {
  size_t clusters = 1;  // wanted; at least 1
  ClusteringStart start = ClusteringStart::hierarchical;
  int iterations = 5;        // of k-means, at most
  int split_iterations = 5;  // of the two-way k-means of each split, at most
  uint64_t seed = 1;         // of a random start
};

// No cluster is empty. There are fewer than wanted where fewer points differ; with as many clusters wanted as
// there are points or more, point i is cluster i.
struct Clustering {
  std::vector<uint32_t> cluster_of;  // by point
  std::vector<Point6> centres;       // means
};

// Points must be finite. No points: no clusters. Large numbers of points and clusters are assigned in
// parallel.
Clustering cluster_points(std::span<const Point6> points, const ClusteringSettings& settings);

// Sum over the points of the squared distance to the centre of their cluster.
double total_distance(std::span<const Point6> points, const Clustering& clustering);

}  // namespace relight::clustered_gather
