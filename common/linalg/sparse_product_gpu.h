// y = scale * (M x) on the GPU, M by rows. The matrix is split into slabs of rows because a shader-storage
// block may be limited to 128 MiB (llvmpipe).
#pragma once

#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/linalg/sparse_rows.h"

namespace relight {

class SparseProductGpu {
 public:
  // scale: one RGB factor a row. max_block_bytes: the context's storage block limit.
  SparseProductGpu(const SparseRows& matrix, const std::vector<glm::vec3>& scale, int64_t max_block_bytes);
  // x: one vec4 a column; y: one vec4 a row.
  void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const;
  int64_t bytes() const;

 private:
  struct Slab {
    uint32_t first_row, rows;
    gpu::Buffer row_start, entries;
  };
  gpu::Program program_;
  std::vector<Slab> slabs_;
  gpu::Buffer scale_;
};

}  // namespace relight
