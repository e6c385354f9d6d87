// y = scale * (M x) on the CPU, M by rows (Hasan 2006 section 5, "Comparison with row-based multiplication"),
// with eight entries at a time in AVX2 and rows in parallel.
//
// Storage: rows in groups of eight entries, each with a 16-bit column (32-bit where the matrix is wider than
// 65,536) and a weight of the chosen format; quantised weights are signed integers with one scale a row. The
// last group of a row is filled up with weight 0 in the row's own last column, so that no row reads a column
// it does not have. x and the sums are interleaved RGB + padding: one 128-bit load fetches the light of a
// column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class SparseProductCpu : public TransferProduct {
 public:
  // row_scale: one RGB factor a row (the diffuse albedo k_d). Throws Error if its length is not the number of
  // rows, or naming row and column of a weight that is not finite or whose column lies outside the matrix.
  SparseProductCpu(const SparseRows& matrix, std::span<const glm::vec3> row_scale, WeightFormat format);

  // x: one vec4 a column, w ignored; y: one vec4 a row, w = 0. Throws Error on other lengths. The sums are in
  // float; the same bits for any number of threads. A non-finite x reaches exactly the rows that have its
  // column.
  void multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const override;
  ProductStatistics statistics() const override;

  size_t rows() const { return row_factor_.size(); }
  uint32_t columns() const { return columns_; }
  // Bytes of the stored matrix: columns, weights, group offsets and row factors.
  int64_t bytes() const { return statistics().bytes; }

 private:
  uint32_t columns_;
  WeightFormat format_;
  int64_t non_zeros_;
  std::vector<uint32_t> group_start_;  // rows + 1 offsets in groups of eight entries
  std::vector<uint16_t> narrow_;       // columns, eight a group; one of the two is empty
  std::vector<uint32_t> wide_;
  std::vector<std::byte> weights_;     // eight a group
  std::vector<glm::vec4> row_factor_;  // row scale times the weights' scale; w = 0
};

}  // namespace relight
