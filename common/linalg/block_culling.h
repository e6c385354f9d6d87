// Transport-weighted culling of wavelet lights on the GPU (Hasan 2006 sections 3.5 and 5): the threshold that
// blocks are compared with, and the count of what was skipped. ProductSettings::cull_epsilon says what is
// skipped.
#pragma once

#include <cstdint>
#include <span>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

// |scale| of one row, root mean square of its channels: what one unit of weight does to the pixel.
float row_response(const glm::vec3& scale);

class BlockCulling {
 public:
  // Bindings of culling.glsl.
  static constexpr int threshold_binding = 6, counters_binding = 7;

  BlockCulling(const SparseRows& matrix, std::span<const glm::vec3> scale, const ProductSettings& settings);
  // Computes the threshold for these lights, clears the counters and binds both. A sum of lights that is not
  // finite culls nothing: what is wrong must reach the picture.
  void begin(const gpu::Buffer& x) const;
  CullStatistics count() const;  // waits for the GPU
  int64_t bytes() const { return norms_.bytes() + threshold_.bytes() + counters_.bytes(); }

 private:
  float epsilon_;
  uint32_t columns_;
  gpu::Program program_;
  gpu::Buffer norms_, threshold_, counters_;
};

}  // namespace relight
