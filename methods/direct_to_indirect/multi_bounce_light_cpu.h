// Applies the multiple-bounce matrix at relight time on the CPU in float: the twin of multi_bounce_light.h
// for machines without a GPU.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/linalg/sparse_product_cpu.h"
#include "common/wavelet/haar_cpu.h"
#include "methods/direct_to_indirect/multi_bounce.h"

namespace relight::direct_to_indirect {

class MultiBounceLightCpu {
 public:
  // data.bounces > 1. cloud: albedos with column scaling folded in.
  MultiBounceLightCpu(MultiBounce data, const GatherCloud& cloud);
  // direct: one vec4 a gather sample, as the light leaves it. Returns the same with bounces added; valid
  // until the next call. The same bits for any number of threads.
  std::span<const glm::vec4> with_bounces(std::span<const glm::vec4> direct);
  int64_t matrix_bytes() const;
  int64_t result_bytes() const {
    return static_cast<int64_t>((light_.size() + coefficients_.size()) * sizeof(glm::vec4)) + haar_.bytes();
  }

 private:
  void multiply_photons();

  SparseRowsRgb photons_;                     // empty unless of this kind
  std::optional<SparseProductCpu> transfer_;  // none unless of this kind
  int passes_;
  wavelet::HaarCpu haar_;
  std::vector<glm::vec4> coefficients_, light_;
};

}  // namespace relight::direct_to_indirect
