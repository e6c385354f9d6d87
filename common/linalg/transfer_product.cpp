#include "common/linalg/transfer_product.h"

#include "common/gpu/buffer.h"
#include "common/run/error.h"

namespace relight {

void check_picture_shape(PictureShape shape, size_t rows) {
  if (shape.width < 0 || shape.height < 0 ||
      static_cast<size_t>(shape.width) * static_cast<size_t>(shape.height) != rows)
    fail("transfer product: a picture of {} x {} pixels for a matrix of {} rows", shape.width, shape.height,
         rows);
}

gpu::Buffer padded_row_scale(const SparseRows& matrix, std::span<const glm::vec3> scale) {
  check_sparse_rows(matrix);
  if (scale.size() != matrix.rows())
    fail("transfer product: {} scales for {} rows", scale.size(), matrix.rows());
  std::vector<glm::vec4> padded;
  for (const glm::vec3& s : scale) padded.emplace_back(s, 0.0f);
  return gpu::Buffer::from(padded);
}

void TransferProductGpu::multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const {
  const gpu::Buffer x_buffer(static_cast<int64_t>(x.size_bytes()), x.data());
  const gpu::Buffer y_buffer(static_cast<int64_t>(y.size_bytes()));
  multiply(x_buffer, y_buffer);
  y_buffer.download(y.data(), static_cast<int64_t>(y.size_bytes()));
}

}  // namespace relight
