// From one indirect value a pixel and 2x2 direct values a pixel to the final image (Hasan 2006 section 3.6): each
// sub-sample takes the indirect value of the closest view sample (by normal and position) in the 3x3 pixels around it,
// then a 2x2 box filter.
#pragma once

#include <cstdint>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/image/image.h"
#include "common/sampling/deep_frame_buffer.h"

namespace relight {

// For each of the 2w x 2h sub-samples: index of the view sample whose indirect value it takes; 0xffffffff where the
// sub-sample hit nothing. Depends on the view only.
std::vector<uint32_t> closest_view_samples(const DeepFrameBuffer& buffer);

// CPU twin. indirect: one radiance a pixel. Returns the box-filtered indirect image.
Image reconstruct_indirect_cpu(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& closest,
                               const std::vector<glm::vec3>& indirect);

// Box filter over each pixel's 2x2 sub-samples.
Image box_filter_2x2(const std::vector<glm::vec3>& subsamples, int width, int height);

// The same on the GPU; logs stage "reconstruction".
class Reconstruction {
 public:
  explicit Reconstruction(const DeepFrameBuffer& buffer);
  // direct: vec4 a sub-sample; indirect: vec4 a pixel. Downloads both filtered images.
  struct Images {
    Image direct, indirect;
  };
  Images resolve(const gpu::Buffer& direct, const gpu::Buffer& indirect, class StageLog& log) const;

 private:
  int width_, height_;
  gpu::Buffer closest_;
};

}  // namespace relight
