// A sparse matrix stored by rows: for each row a run of (column, value) entries, columns ascending.
#pragma once

#include <cstdint>
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
  int64_t bytes() const {
    return static_cast<int64_t>(row_start.size() * sizeof(uint64_t) + entries.size() * sizeof(SparseEntry));
  }
};

// y = M x for an RGB vector x, summed in double: the oracle of the GPU product. Parallel over rows,
// deterministic.
std::vector<glm::vec3> multiply(const SparseRows& m, const std::vector<glm::dvec3>& x);

}  // namespace relight
