// y = scale * (M x) on the GPU, M by rows (Hasan 2006 section 5, "Comparison with row-based multiplication").
// The matrix is split into slabs of rows because a shader-storage block may be limited to 128 MiB (llvmpipe).
//
// Storage: groups of sixteen entries in whole texels, 16-bit columns (32-bit where the matrix is wider than
// 65,536), weights of the chosen format with one step a row. The last group of a row is filled up with weight
// 0 in the row's own last column.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/gpu/texel_view.h"
#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class SparseProductGpu : public TransferProductGpu {
 public:
  // scale: one RGB factor a row. max_block_bytes: the context's storage block limit. Throws Error on another
  // number of scales, on a weight that is not finite, and on a row that doesn't fit a storage block.
  SparseProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale, int64_t max_block_bytes,
                   WeightFormat format = WeightFormat::float32);
  using TransferProductGpu::multiply;
  // x: one vec4 a column; y: one vec4 a row.
  void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const override;
  ProductStatistics statistics() const override;
  int64_t bytes() const { return statistics().bytes; }

 private:
  struct Slab {
    uint32_t first_row, rows;
    gpu::Buffer group_start, groups;
    gpu::TexelView view;  // of groups
  };
  gpu::Program program_;
  uint32_t columns_;
  int64_t non_zeros_, stored_ = 0;
  std::vector<Slab> slabs_;
  gpu::Buffer scale_;
};

}  // namespace relight
