// y = scale * (M x) on the GPU with one workgroup a tile of 16x8 pixels, which loops over the tile's list of
// blocks: one for each column that any of its pixels has, from the first line of the tile that has it to the
// last. Sums stay in registers, where the paper's quads (quad_product_gpu.h) blend them in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/gpu/texel_view.h"
#include "common/linalg/block_culling.h"
#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class TileProductGpu : public TransferProductGpu {
 public:
  // max_block_bytes: the context's storage block limit; tiles are split into slabs by it. Throws Error as the
  // other forms; and for a matrix of more than 2^24 columns.
  TileProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                 const ProductSettings& settings, int64_t max_block_bytes);
  using TransferProductGpu::multiply;
  void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const override;
  ProductStatistics statistics() const override { return statistics_; }
  CullStatistics culled() const override { return culling_.count(); }

 private:
  struct Slab {
    uint32_t first_tile, tiles;
    gpu::Buffer start, blocks;
    gpu::TexelView view;  // of blocks
  };
  PictureShape shape_;
  uint32_t columns_;
  gpu::Buffer scale_;  // before culling_: its making checks the arguments
  BlockCulling culling_;
  gpu::Program program_;
  std::vector<Slab> slabs_;
  ProductStatistics statistics_;
};

}  // namespace relight
