// The inverse transform of picture_haar.h in GLSL.
#pragma once

#include <span>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/wavelet/picture_haar.h"

namespace relight::wavelet {

class PictureHaarGpu {
 public:
  // factor: one a pixel. Needs a current context.
  PictureHaarGpu(const PictureHaar& haar, std::span<const glm::vec3> factor);
  // Both of width x height vec4.
  void inverse(const gpu::Buffer& coefficients, const gpu::Buffer& pixels) const;
  int64_t bytes() const { return factor_.bytes(); }

 private:
  int width_, height_;
  gpu::Program program_;
  gpu::Buffer factor_;  // alpha: is the pixel's tile transformed?
};

}  // namespace relight::wavelet
