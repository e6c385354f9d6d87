// Direct light of the environment at relight time: what the view clusters gather from their environment
// samples, interpolated between them like indirect light.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/linalg/sparse_product_rgb_gpu.h"
#include "common/run/method.h"
#include "common/sampling/environment_samples.h"
#include "common/shading/environment_picture.h"
#include "methods/clustered_gather/artefact.h"

namespace relight::clustered_gather {

class EnvironmentLight {
 public:
  // From what each view cluster gathers to the radiance of each pixel.
  using InterpolateGpu = std::function<void(const gpu::Buffer& gathered, const gpu::Buffer& pixels)>;
  using InterpolateCpu = std::function<std::vector<glm::vec4>(const std::vector<glm::dvec3>& gathered)>;

  // rows: one a view cluster. gpu: makes the product there; false: in double on the CPU. Logs bytes
  // environment_samples and environment_light.
  EnvironmentLight(const PrepareContext& context, SparseRowsRgb rows, bool gpu);

  // Computes the light of an environment that isn't black; stage and counter `environment`.
  void update(const Environment& environment, const InterpolateGpu& interpolate, StageLog& log);
  void update(const Environment& environment, const InterpolateCpu& interpolate, StageLog& log);
  // Direct light of the environment, where the eye sees it included.
  const Image& picture() const { return picture_; }

 private:
  SparseRowsRgb rows_;  // empty once a product is made of it
  EnvironmentSquare square_;
  EnvironmentPicture upsampling_;
  Image picture_;
  std::optional<SparseProductRgbGpu> product_;
  std::optional<gpu::Buffer> radiance_, gathered_, pixels_;
};

// None unless the gather samples were made for an environment; uses their environment rows up.
std::optional<EnvironmentLight> make_environment_light(const PrepareContext& context, GatherSamples& gather,
                                                       bool gpu);

}  // namespace relight::clustered_gather
