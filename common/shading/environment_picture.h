// Direct light of an environment in the picture: what surfaces reflect of it, computed at view samples and
// upsampled as indirect light is (Hasan 2006 section 3.6), and the environment itself where the eye sees
// nothing else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "common/lights/environment.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/shading/reconstruction.h"

namespace relight {

class EnvironmentPicture {
 public:
  // `buffer` must outlive this.
  explicit EnvironmentPicture(const DeepFrameBuffer& buffer, Upsampling upsampling = Upsampling::closest);

  // reflected: radiance of each value of IndirectSources, w ignored. Box-filtered over the 2x2 sub-pixels.
  // Pixels that are not finite are counted (non_finite_reconstruction), warned of and replaced by zero
  // (debug: an Error).
  Image resolve(const Environment& environment, std::span<const glm::vec4> reflected, StageLog& log) const;
  int64_t bytes() const { return static_cast<int64_t>(sources_.size() * sizeof(uint32_t)); }

 private:
  const DeepFrameBuffer& buffer_;
  std::vector<uint32_t> sources_;  // of each sub-sample: whose value it takes
};

// Adds `from` to `to`, pixel by pixel.
void add_image(const Image& from, Image& to);

}  // namespace relight
