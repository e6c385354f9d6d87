// y = scale * (M x) on the CPU with matrix rows in patches of eight pixels that share one list of columns
// (pixel_patches.h): each column costs three broadcasts of its light and three multiply-adds for eight
// pixels, and one index is stored for eight weights. Quantised weights are signed integers with one step a
// row, applied once at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/linalg/pixel_patches.h"
#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class PatchProductCpu : public TransferProduct {
 public:
  // Errors as SparseProductCpu; and if shape doesn't have one pixel a row.
  PatchProductCpu(const SparseRows& matrix, std::span<const glm::vec3> row_scale, PictureShape shape,
                  WeightFormat format);
  // The same bits for any number of threads. A non-finite x reaches all pixels of the patches that have its
  // column.
  void multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const override;
  ProductStatistics statistics() const override;

 private:
  uint32_t columns_;
  WeightFormat format_;
  int64_t non_zeros_;
  PixelPatches patches_;
  std::vector<uint32_t> start_;   // patches + 1 offsets in columns
  std::vector<uint16_t> narrow_;  // columns; one of the two is empty
  std::vector<uint32_t> wide_;
  std::vector<std::byte> weights_;     // eight a column
  std::vector<glm::vec4> row_factor_;  // row scale times the weights' step; w = 0
};

}  // namespace relight
