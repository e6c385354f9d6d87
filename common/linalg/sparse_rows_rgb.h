// A sparse matrix with RGB elements stored by rows; each channel is a matrix of its own with the same
// pattern.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

struct SparseEntryRgb {
  uint32_t column;
  glm::vec3 value;
};
static_assert(sizeof(SparseEntryRgb) == 16);  // the GPU reads it as four words

struct SparseRowsRgb {
  uint32_t columns = 0;             // width of the matrix
  std::vector<uint64_t> row_start;  // rows + 1 offsets into entries
  std::vector<SparseEntryRgb> entries;

  size_t rows() const { return row_start.empty() ? 0 : row_start.size() - 1; }
  int64_t bytes() const {
    return static_cast<int64_t>(row_start.size() * sizeof(uint64_t) +
                                entries.size() * sizeof(SparseEntryRgb));
  }
};

// y = M x channel by channel, summed in double: the oracle of the GPU product. Parallel over rows,
// deterministic. Throws Error if x has not one value a column.
std::vector<glm::dvec3> multiply(const SparseRowsRgb& m, const std::vector<glm::dvec3>& x);

}  // namespace relight
