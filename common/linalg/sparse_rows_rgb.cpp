#include "common/linalg/sparse_rows_rgb.h"

#include <tbb/parallel_for.h>

#include "common/run/error.h"

namespace relight {

std::vector<glm::dvec3> multiply(const SparseRowsRgb& m, const std::vector<glm::dvec3>& x) {
  if (x.size() != m.columns)
    fail("sparse RGB product: vector of {} values for a matrix of {} columns", x.size(), m.columns);
  std::vector<glm::dvec3> y(m.rows());
  tbb::parallel_for(size_t{0}, m.rows(), [&](size_t row) {
    glm::dvec3 sum(0.0);
    for (uint64_t e = m.row_start[row]; e < m.row_start[row + 1]; ++e)
      sum += glm::dvec3(m.entries[e].value) * x[m.entries[e].column];
    y[row] = sum;
  });
  return y;
}

}  // namespace relight
