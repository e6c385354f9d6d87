// y += scale * (M x) for a matrix with rows for some pixels of a picture only (partial_picture.h): a second
// matrix beside the one that writes all of y. Any form of the transfer product (product_list.h) does the
// work.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/linalg/partial_picture.h"
#include "common/linalg/transfer_product.h"

namespace relight {

// What a partial product is made of. pixels: of the rows, ascending; scale: one RGB factor a row.
struct PartialMatrix {
  const SparseRows& rows;
  std::span<const uint32_t> pixels;
  std::span<const glm::vec3> scale;
  PictureShape picture;
};

class PartialProductCpu {
 public:
  // Throws Error as the forms do, and unless there is a pixel and a scale for each row.
  PartialProductCpu(const std::string& form, const PartialMatrix& matrix, const ProductSettings& settings);
  // y: one vec4 a pixel of the whole picture.
  void add(std::span<const glm::vec4> x, std::span<glm::vec4> y);
  // Bytes of the places and partial results included.
  ProductStatistics statistics() const;

 private:
  PartialPicture picture_;
  std::unique_ptr<TransferProduct> product_;
  std::vector<glm::vec4> result_;
};

class PartialProductGpu {
 public:
  PartialProductGpu(const std::string& form, const PartialMatrix& matrix, const ProductSettings& settings,
                    int64_t max_block_bytes);
  void add(const gpu::Buffer& x, const gpu::Buffer& y) const;
  ProductStatistics statistics() const;
  CullStatistics culled() const { return product_->culled(); }

 private:
  std::unique_ptr<TransferProductGpu> product_;
  gpu::Program program_;
  gpu::Buffer pixel_at_, result_;
};

}  // namespace relight
