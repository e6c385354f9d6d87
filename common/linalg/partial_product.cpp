#include "common/linalg/partial_product.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "common/linalg/product_list.h"
#include "common/run/error.h"

namespace relight {
namespace {

PartialPicture make_picture(const PartialMatrix& matrix) {
  if (matrix.pixels.size() != matrix.rows.rows() || matrix.scale.size() != matrix.rows.rows())
    fail("partial product: {} pixels and {} scales for {} rows", matrix.pixels.size(), matrix.scale.size(),
         matrix.rows.rows());
  return {matrix.picture, matrix.pixels};
}

}  // namespace

PartialProductCpu::PartialProductCpu(const std::string& form, const PartialMatrix& matrix,
                                     const ProductSettings& settings)
    : picture_(make_picture(matrix)),
      product_(make_product_cpu(form, picture_.spread(matrix.rows), picture_.spread(matrix.scale),
                                picture_.shape(), settings)),
      result_(picture_.pixel_at().size()) {}

void PartialProductCpu::add(std::span<const glm::vec4> x, std::span<glm::vec4> y) {
  product_->multiply(x, result_);
  const std::vector<uint32_t>& pixel_at = picture_.pixel_at();
  tbb::parallel_for(tbb::blocked_range<size_t>(0, pixel_at.size(), 4096), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i)
      if (pixel_at[i] != PartialPicture::no_pixel) y[pixel_at[i]] += result_[i];
  });
}

ProductStatistics PartialProductCpu::statistics() const {
  ProductStatistics s = product_->statistics();
  s.bytes += static_cast<int64_t>(result_.size() * (sizeof(glm::vec4) + 2 * sizeof(uint32_t)));
  return s;
}

PartialProductGpu::PartialProductGpu(const std::string& form, const PartialMatrix& matrix,
                                     const ProductSettings& settings, int64_t max_block_bytes)
    : program_(gpu::Program::compute("common/linalg/partial_sum.glsl")) {
  const PartialPicture picture = make_picture(matrix);
  product_ = make_product_gpu(form, picture.spread(matrix.rows), picture.spread(matrix.scale),
                              picture.shape(), settings, max_block_bytes);
  pixel_at_ = gpu::Buffer::from(picture.pixel_at());
  result_ = gpu::Buffer(static_cast<int64_t>(picture.pixel_at().size() * sizeof(glm::vec4)));
}

void PartialProductGpu::add(const gpu::Buffer& x, const gpu::Buffer& y) const {
  product_->multiply(x, result_);
  const int64_t count = result_.bytes() / static_cast<int64_t>(sizeof(glm::vec4));
  program_.use();
  result_.bind_storage(0);
  pixel_at_.bind_storage(1);
  y.bind_storage(2);
  program_.set("count", static_cast<uint32_t>(count));
  program_.dispatch_items(count, 64);
}

ProductStatistics PartialProductGpu::statistics() const {
  ProductStatistics s = product_->statistics();
  s.bytes += pixel_at_.bytes() + result_.bytes();
  return s;
}

}  // namespace relight
