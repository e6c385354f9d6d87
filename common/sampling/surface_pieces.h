// The scene's surfaces cut into small one-sided pieces, each with an importance: what gather samples are
// spread over.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "common/sampling/importance_map.h"

namespace relight {

// One side of a part of a triangle. Corners are barycentrics (u, v) of the triangle's vertices 1 and 2.
struct SurfacePiece {
  uint32_t triangle;
  bool flipped;  // the side away from the triangle's area normal
  glm::vec2 corner[3];
  float area;
  float importance;  // expected gather samples are proportional to area x importance
  glm::vec3 centroid;
};

// Cuts every triangle of non-zero area by its longest edge until no piece is larger than `largest`; two
// pieces, one a side, from each part. Importance 1 for all.
std::vector<SurfacePiece> cut_surfaces(const Scene& scene, double largest);

// Sets importances from the map and removes pieces without any. Importance = particle density relative to its
// mean over what was hit, between `least` and infinity; with `binary`, 1 for every piece that was hit.
void apply_importance(std::vector<SurfacePiece>& pieces, const ImportanceMap& map, float least, bool binary);

double total_area(const std::vector<SurfacePiece>& pieces);

}  // namespace relight
