// Applies the multiple-bounce matrix at relight time: the inner bracket of equation 7,
//   (M^w W + I) g_d.
// Of kind `transfer` by Horner's rule:  s <- g + rho * (G^w W s), bounces - 1 times from s = g.
#pragma once

#include <optional>
#include <vector>

#include "common/linalg/sparse_product_gpu.h"
#include "common/linalg/sparse_product_rgb_gpu.h"
#include "common/linalg/vector_sum_gpu.h"
#include "common/wavelet/haar_gpu.h"
#include "methods/direct_to_indirect/multi_bounce.h"

namespace relight::direct_to_indirect {

class MultiBounceLight {
 public:
  // data.bounces > 1. cloud: albedos with column scaling folded in.
  MultiBounceLight(MultiBounce data, const GatherCloud& cloud, int64_t max_block_bytes);
  // direct: one vec4 a gather sample, as the light leaves it. Returns the same with bounces added; valid
  // until the next call. Uses up haar's coefficients.
  const gpu::Buffer& with_bounces(const gpu::Buffer& direct, const wavelet::HaarGpu& haar) const;
  // The double-precision twin.
  std::vector<glm::dvec3> with_bounces(const std::vector<glm::dvec3>& direct) const;

  int64_t matrix_bytes() const { return data_.photons.bytes() + data_.transfer.bytes(); }
  int64_t gpu_bytes() const;  // of the matrix
  int64_t result_bytes() const { return light_.bytes(); }

 private:
  bool by_photons() const { return data_.photons.rows() > 0; }
  int passes() const { return by_photons() ? 1 : data_.bounces - 1; }

  MultiBounce data_;
  std::vector<glm::vec3> albedo_;
  std::optional<SparseProductRgbGpu> photons_;
  std::optional<SparseProductGpu> transfer_;
  VectorSumGpu sum_;
  gpu::Buffer light_;
};

}  // namespace relight::direct_to_indirect
