// Directions of a view cluster that hit nothing, as environment samples (Hasan 2006 section 6; not in the
// clustered gather paper, where they are black). They are clustered by direction: an environment sample is a
// node of the quad-tree over the environment square (common/sampling/environment_samples.h), with the weight
// of the directions in it, and its radiance is the environment's mean over the node. A row holds a view
// cluster's samples; columns are nodes in the order of radiance_pyramid().
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "common/linalg/sparse_rows_rgb.h"

namespace relight::clustered_gather {

// A direction that hit nothing: the texel that it points to, and its weight.
struct Miss {
  uint32_t texel;
  glm::vec3 weight;
};

// Reduces the misses to `limit` nodes at most (0: all texels): the node with the largest weight x width is
// cut into its quarters until there are as many. levels: of the tree, so that the square has 4^levels texels.
// The weights keep their sum. Reorders `misses`.
std::vector<SparseEntryRgb> environment_samples(std::vector<Miss>& misses, int levels, size_t limit);

}  // namespace relight::clustered_gather
