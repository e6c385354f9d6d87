// The forward Haar transform of haar.h in GLSL: one dispatch a level.
#pragma once

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"

namespace relight::wavelet {

class HaarGpu {
 public:
  // values: 4^n vec4 values in tree order. Allocates the ping-pong buffers once.
  explicit HaarGpu(int64_t values);
  // `values` stays as it is; the coefficients are in coefficients() afterwards.
  void forward(const gpu::Buffer& values) const;
  const gpu::Buffer& coefficients() const { return coefficients_; }
  int64_t bytes() const;

 private:
  int64_t size_;
  gpu::Program program_;
  gpu::Buffer ping_, pong_, coefficients_;
};

}  // namespace relight::wavelet
