// y = scale * (M x) the paper's way (Hasan 2006 sections 3.5, 4.4 and 5; GPU Gems 3, listing 9-9): the
// columns of M are pictures, cut into rectangles and packed into texture atlases; each rectangle is one
// instanced quad of weights times the intensity of its wavelet light, blended into a float target. The vertex
// shader moves culled quads out of the view.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/object.h"
#include "common/gpu/program.h"
#include "common/gpu/texture.h"
#include "common/linalg/block_culling.h"
#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class QuadProductGpu : public TransferProductGpu {
 public:
  // Throws Error as the other forms; and if the picture is larger than a texture or vertex shaders have too
  // few storage blocks on this driver.
  QuadProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                 const ProductSettings& settings);
  using TransferProductGpu::multiply;
  void multiply(const gpu::Buffer& x, const gpu::Buffer& y) const override;
  ProductStatistics statistics() const override { return statistics_; }
  CullStatistics culled() const override { return culling_.count(); }

 private:
  // Quads of one atlas that fit one storage block.
  struct Batch {
    size_t atlas;
    int quads;
    gpu::Buffer instances;
  };
  void draw(const gpu::Buffer& x) const;

  PictureShape shape_;
  uint32_t columns_;
  gpu::Buffer scale_;  // before culling_: its making checks the arguments
  BlockCulling culling_;
  gpu::Program draw_, resolve_;
  gpu::Object vertex_array_;
  std::vector<gpu::Texture> atlases_;
  std::vector<Batch> batches_;  // sorted by atlas
  gpu::Texture sums_;
  gpu::Framebuffer framebuffer_;
  ProductStatistics statistics_;
};

}  // namespace relight
