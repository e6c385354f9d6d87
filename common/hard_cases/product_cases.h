// Matrices and lights that are hard on the forms of the transfer product (common/linalg).
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "common/hard_cases/hard_case.h"
#include "common/linalg/sparse_rows.h"

namespace relight::hard {

Cases product_cases();

// Largest ratio of |y - scale * (m x)| to its bound over all rows and channels: 1 or less is right. The
// bound: each weight may be off by half of `steps[row]`, and n float products summed in any order by n + 2
// roundings of their magnitudes. `row`: where it is.
double product_error_over_bound(const SparseRows& m, std::span<const glm::vec4> x,
                                std::span<const glm::vec3> scale, std::span<const glm::vec4> y,
                                std::span<const float> steps, size_t& row);

}  // namespace relight::hard
