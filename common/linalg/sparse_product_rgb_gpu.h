// y = M x on the GPU for a matrix with RGB elements, by rows. Split into slabs of rows because a
// shader-storage block may be limited to 128 MiB (llvmpipe).
#pragma once

#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/gpu/texel_view.h"
#include "common/linalg/sparse_rows_rgb.h"

namespace relight {

class SparseProductRgbGpu {
 public:
  // max_block_bytes: the context's storage block limit. Throws Error if a single row exceeds it.
  SparseProductRgbGpu(const SparseRowsRgb& matrix, int64_t max_block_bytes);
  // x: one vec4 a column; y: one vec4 a row.
  void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const;
  int64_t bytes() const;

 private:
  struct Slab {
    uint32_t first_row, rows;
    gpu::Buffer row_start, entries;
    gpu::TexelView view;  // of entries
  };
  static Slab make_slab(const SparseRowsRgb& matrix, size_t first, size_t last);

  gpu::Program program_;
  std::vector<Slab> slabs_;
};

}  // namespace relight
