// The gather hierarchy (Hasan 2006 sections 3.4 and 4.2): a perfectly balanced quad-tree over 4^n gather
// samples, built top-down by the sorted two-way split. The samples are reordered so that each cluster is a
// contiguous aligned run
// ("tree order", common/wavelet/haar.h): the tree itself needs no pointers.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "common/sampling/gather_cloud.h"

namespace relight::direct_to_indirect {

// What the final gather asks of a cluster.
struct Cluster {
  glm::vec3 lo, hi;     // bounding box of the members' positions
  glm::vec3 cone_axis;  // unit; every member's geometric normal is within the cone around it
  float cone_cosine;    // cosine of the cone's half-angle; -1 if the members' mean normal is zero
};

// What a link asks of a gather sample, in a quarter of the sample's bytes: links read random members. Also
// the mean of a cluster's members: the mean of their areas, and weighted by area of positions and normals, so
// that its element of the matrix, far away, is the mean of theirs.
struct GatherPoint {
  glm::vec3 position;
  float area;        // represented
  glm::vec3 normal;  // geometric; shorter than one in a mean of normals that differ
  float padding = 0.0f;
};

struct GatherHierarchy {
  // levels[0] = {root}, levels[l][i] = the cluster of samples [i, i+1) x 4^(n-l); the last level has single
  // samples.
  std::vector<std::vector<Cluster>> levels;
  std::vector<GatherPoint> points;              // in tree order
  std::vector<std::vector<GatherPoint>> means;  // like levels, but for the last, which is `points`
};

// Reorders the cloud into tree order. k: weight of positions in d(s,c) = k^2 |p_s-p_c|^2 + d^2 |n_s-n_c|^2
// (equation 9), d = scene_diagonal. Deterministic for any number of threads; ties are broken by the sample's
// number. Throws Error if the number of samples is not a power of four.
void order_gather_cloud(GatherCloud& cloud, float k, float scene_diagonal);

GatherHierarchy build_hierarchy(const GatherCloud& ordered_cloud);

}  // namespace relight::direct_to_indirect
