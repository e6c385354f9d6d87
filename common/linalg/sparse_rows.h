// A sparse matrix stored by rows: for each row a run of (column, value) entries, columns ascending.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

struct SparseEntry {
  uint32_t column;
  float value;
};

struct SparseRows {
  uint32_t columns = 0;             // width of the matrix
  std::vector<uint64_t> row_start;  // rows + 1 offsets into entries
  std::vector<SparseEntry> entries;

  size_t rows() const { return row_start.empty() ? 0 : row_start.size() - 1; }
  std::span<const SparseEntry> row(size_t r) const {
    return {entries.data() + row_start[r], static_cast<size_t>(row_start[r + 1] - row_start[r])};
  }
  int64_t bytes() const {
    return static_cast<int64_t>(row_start.size() * sizeof(uint64_t) + entries.size() * sizeof(SparseEntry));
  }
};

// y = M x for an RGB vector x, summed in double: the oracle of the GPU product. Parallel over rows,
// deterministic.
std::vector<glm::vec3> multiply(const SparseRows& m, const std::vector<glm::dvec3>& x);

// Throws Error naming row and column of the first entry whose column lies outside the matrix or whose value
// is not finite: a quantised form would turn it into some harmless-looking number.
void check_sparse_rows(const SparseRows& m);

// Throws Error unless x has one value a column and y one a row.
void check_product_shape(size_t columns, size_t rows, size_t x_size, size_t y_size);

}  // namespace relight
