// Matrices and vectors for the products, and the bound that each row of a product has to keep.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/weight_format.h"

namespace relight::check {

// Each element non-zero with probability `density`, of either sign; every seventh row empty.
SparseRows random_matrix(size_t rows, uint32_t columns, float density);

// As transfer is: column c is a smooth blob on a picture of width x height pixels (row y * width + x), wide
// for small c and narrow for large c; pixels of a hashed tenth of the picture see nothing. About
// `mean_entries` a row.
SparseRows image_like_matrix(int width, int height, uint32_t columns, int mean_entries);

std::vector<glm::vec4> random_light(uint32_t columns);
std::vector<glm::vec3> random_scale(size_t rows);

// Fails the test, naming the row, unless every y[row] is within the bound of the double-precision oracle:
// each weight may be off by half of `steps[row]`, and n float products summed in any order by n + 2 roundings
// of their magnitudes.
void expect_product(const SparseRows& m, std::span<const glm::vec4> x, std::span<const glm::vec3> scale,
                    std::span<const glm::vec4> y, std::span<const float> steps);

// Step of the weights of each row for a row-based form; 0 for float32.
std::vector<float> row_steps(const SparseRows& m, WeightFormat format);

}  // namespace relight::check
