// Light of the environment at relight time, on the GPU and in double precision: the products of
// environment_transfer.h, made again only when the environment changes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/linalg/partial_product.h"
#include "common/linalg/sparse_product_gpu.h"
#include "common/linalg/vector_sum_gpu.h"
#include "common/run/method.h"
#include "common/sampling/environment_samples.h"
#include "common/shading/environment_picture.h"
#include "common/shading/kept_environment.h"
#include "common/wavelet/haar_gpu.h"
#include "methods/direct_to_indirect/artefact.h"
#include "methods/direct_to_indirect/indirect_grid.h"

namespace relight::direct_to_indirect {

class EnvironmentLight {
 public:
  // matrices: not empty. cloud: albedos with column scaling folded in. With device=oracle products are in
  // double on the CPU. Logs bytes environment_matrix, of the products, and environment_light.
  EnvironmentLight(const PrepareContext& context, const IndirectGrid& grid, EnvironmentTransfer matrices,
                   const GatherCloud& cloud);

  // Computes the light of an environment that isn't black; stage and counter `environment`.
  void update(const Environment& environment, StageLog& log);

  // Direct light of the environment, where the eye sees it included.
  const Image& picture() const { return picture_; }
  // `direct`, one vec4 a gather sample as light leaves it, with the environment's added; valid until the next
  // call.
  const gpu::Buffer& added_to(const gpu::Buffer& direct) const;
  // The same in double, in place; with device=oracle.
  void add_to(std::vector<glm::dvec3>& direct) const;

 private:
  void update_on_gpu(const std::vector<glm::dvec3>& radiance);
  void update_in_double(const std::vector<glm::dvec3>& radiance);

  bool oracle_;
  EnvironmentSquare square_;
  EnvironmentTransfer matrices_;  // of the oracle; else empty once products are made of them
  std::vector<uint32_t> glossy_pixels_;
  std::vector<glm::vec3> kd_, kg_, albedo_;  // of the oracle, and of gather samples
  std::vector<glm::dvec3> gather_in_double_;
  EnvironmentPicture upsampling_;
  Image picture_;
  wavelet::HaarGpu haar_;
  gpu::Buffer radiance_, reflected_, gather_, sum_;
  std::unique_ptr<TransferProductGpu> view_;     // none for the oracle
  std::optional<PartialProductGpu> glossy_;      // none without glossy pixels
  std::optional<SparseProductGpu> gather_rows_;  // none for the oracle
  VectorSumGpu vector_sum_;
};

}  // namespace relight::direct_to_indirect
