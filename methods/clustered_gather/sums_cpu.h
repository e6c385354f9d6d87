// Both sums of equation 3 on the CPU (clustered gather paper, 2006): in float the method's CPU form, in double
// the oracle of the GPU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

class SumsCpu {
 public:
  SumsCpu() = default;
  // first: of GatherSamples. Copies the albedo of the buffer's pixels.
  SumsCpu(std::vector<uint32_t> first, Links links, const DeepFrameBuffer& buffer);

  // Irradiance / pi of each view cluster. Real: float or double, of the sums. Parallel; same bits for any
  // number of threads.
  template <typename Real>
  std::vector<glm::vec<3, Real>> irradiance(std::span<const glm::vec4> radiance) const;
  // Indirect radiance of each pixel.
  template <typename Real>
  std::vector<glm::vec4> interpolate(const std::vector<glm::vec<3, Real>>& irradiance) const;
  // Both.
  template <typename Real>
  std::vector<glm::vec4> indirect(std::span<const glm::vec4> radiance) const {
    return interpolate<Real>(irradiance<Real>(radiance));
  }
  int64_t bytes() const;

 private:
  std::vector<uint32_t> first_;
  Links links_;
  std::vector<glm::vec3> albedo_;
};

}  // namespace relight::clustered_gather
