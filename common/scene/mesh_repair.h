// Finds triangles that a renderer cannot use, with CGAL's exact predicates and polygon-soup tools. The
// implementation is one translation unit of its own: CGAL wants other floating-point flags than the rest of
// relight.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "common/scene/scene.h"

namespace relight {

enum class TriangleFault : uint8_t { none, zero_area, duplicate };

// For each triangle its fault. zero_area: exactly collinear corners, or an area that vanishes in single
// precision. duplicate: the same three positions, in any order, as an earlier sound triangle (surfaces are
// two-sided, so a reversed copy adds nothing). Only positions matter: vertices with different normals or uvs
// are never merged. Positions must be finite and indices valid.
std::vector<TriangleFault> find_triangle_faults(const std::vector<glm::vec3>& positions,
                                                const std::vector<Triangle>& triangles);

}  // namespace relight
