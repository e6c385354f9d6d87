// Light of the environment at relight time on the CPU in float: the twin of environment_light.h for machines
// without a GPU.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/linalg/partial_product.h"
#include "common/linalg/sparse_product_cpu.h"
#include "common/run/method.h"
#include "common/sampling/environment_samples.h"
#include "common/shading/environment_picture.h"
#include "common/shading/kept_environment.h"
#include "common/wavelet/haar_cpu.h"
#include "methods/direct_to_indirect/artefact.h"
#include "methods/direct_to_indirect/indirect_grid.h"

namespace relight::direct_to_indirect {

class EnvironmentLightCpu {
 public:
  // As in environment_light.h.
  EnvironmentLightCpu(const PrepareContext& context, const IndirectGrid& grid,
                      const EnvironmentTransfer& matrices, const GatherCloud& cloud);

  void update(const Environment& environment, StageLog& log);
  const Image& picture() const { return picture_; }
  // `direct`, one vec4 a gather sample, with the environment's light added; valid until the next call.
  std::span<const glm::vec4> added_to(std::span<const glm::vec4> direct);

 private:
  EnvironmentSquare square_;
  EnvironmentPicture upsampling_;
  Image picture_;
  wavelet::HaarCpu haar_;
  std::unique_ptr<TransferProduct> view_;
  std::optional<PartialProductCpu> glossy_;  // none without glossy pixels
  std::optional<SparseProductCpu> gather_rows_;
  std::vector<glm::vec4> radiance_, coefficients_, reflected_, gather_, sum_;
};

}  // namespace relight::direct_to_indirect
