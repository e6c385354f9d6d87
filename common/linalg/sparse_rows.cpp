#include "common/linalg/sparse_rows.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "common/run/error.h"

namespace relight {

std::vector<glm::vec3> multiply(const SparseRows& m, const std::vector<glm::dvec3>& x) {
  check_product_shape(m.columns, m.rows(), x.size(), m.rows());
  std::vector<glm::vec3> y(m.rows());
  tbb::parallel_for(size_t{0}, m.rows(), [&](size_t row) {
    glm::dvec3 sum(0.0);
    for (uint64_t e = m.row_start[row]; e < m.row_start[row + 1]; ++e)
      sum += static_cast<double>(m.entries[e].value) * x[m.entries[e].column];
    y[row] = glm::vec3(sum);
  });
  return y;
}

void check_sparse_rows(const SparseRows& m) {
  for (size_t row = 0; row < m.rows(); ++row) {
    for (const SparseEntry& e : m.row(row)) {
      if (e.column >= m.columns)
        fail("sparse product: row {} has an entry in column {} of {}", row, e.column, m.columns);
      if (!std::isfinite(e.value))
        fail("sparse product: the entry of row {}, column {} is {}", row, e.column, e.value);
    }
  }
}

void check_product_shape(size_t columns, size_t rows, size_t x_size, size_t y_size) {
  if (x_size != columns)
    fail("sparse product: vector of {} values for a matrix of {} columns", x_size, columns);
  if (y_size != rows) fail("sparse product: room for {} sums for a matrix of {} rows", y_size, rows);
}

}  // namespace relight
