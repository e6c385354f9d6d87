// Sum of two vectors of vec4 on the GPU.
#pragma once

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"

namespace relight {

class VectorSumGpu {
 public:
  VectorSumGpu();
  // target += source. Throws Error if their sizes differ.
  void add(const gpu::Buffer& source, const gpu::Buffer& target) const;

 private:
  gpu::Program program_;
};

}  // namespace relight
