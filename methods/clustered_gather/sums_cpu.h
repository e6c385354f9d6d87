// Both sums of equation 3 on the CPU (clustered gather paper, 2006): in float the method's CPU form, in
// double the oracle of the GPU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "methods/clustered_gather/artefact.h"

namespace relight::clustered_gather {

class SumsCpu {
 public:
  SumsCpu() = default;
  // Copies the albedo of the buffer's pixels; drops the samples themselves.
  SumsCpu(Artefact artefact, const DeepFrameBuffer& buffer);

  // What each view cluster gathers: irradiance / pi of diffuse ones, reflected radiance of glossy ones. Real:
  // float or double, of the sums. Parallel; same bits for any number of threads.
  template <typename Real>
  std::vector<glm::vec<3, Real>> gathered(std::span<const glm::vec4> radiance) const;
  // Indirect radiance of each pixel.
  template <typename Real>
  std::vector<glm::vec4> interpolate(const std::vector<glm::vec<3, Real>>& gathered) const;
  // Both.
  template <typename Real>
  std::vector<glm::vec4> indirect(std::span<const glm::vec4> radiance) const {
    return interpolate<Real>(gathered<Real>(radiance));
  }
  int64_t bytes() const;

 private:
  std::vector<uint32_t> first_;
  Links diffuse_, glossy_;
  std::vector<glm::vec3> albedo_;
};

}  // namespace relight::clustered_gather
