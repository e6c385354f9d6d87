// How a triangle mesh hangs together once vertices at equal positions count as one. Shading attributes split
// vertices, so indices alone would report every crease as a hole.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "common/scene/scene.h"

namespace relight {

// For each vertex the first vertex with exactly the same position (0.0 and -0.0 are the same).
std::vector<uint32_t> weld_positions(const std::vector<glm::vec3>& positions);

struct EdgeReport {
  int64_t edges = 0;         // after welding
  int64_t boundary = 0;      // with one triangle
  int64_t non_manifold = 0;  // with more than two
  int64_t flipped = 0;       // with two triangles that run along it in the same direction
  bool closed() const { return edges > 0 && boundary == 0 && non_manifold == 0 && flipped == 0; }
};
EdgeReport examine_edges(const std::vector<uint32_t>& welded, const std::vector<Triangle>& triangles);

// Connected part of each triangle, numbered from 0 in order of their first triangles.
std::vector<uint32_t> connected_components(const std::vector<uint32_t>& welded,
                                           const std::vector<Triangle>& triangles);

// Volume enclosed by a closed mesh [scene units^3]; positive if its triangles face outward (divergence
// theorem).
double signed_volume(const std::vector<glm::vec3>& positions, const std::vector<Triangle>& triangles);

}  // namespace relight
