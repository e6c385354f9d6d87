#include "common/linalg/vector_sum_gpu.h"

#include "common/run/error.h"

namespace relight {

VectorSumGpu::VectorSumGpu() : program_(gpu::Program::compute("common/linalg/vector_sum.glsl")) {}

void VectorSumGpu::add(const gpu::Buffer& source, const gpu::Buffer& target) const {
  if (source.bytes() != target.bytes())
    fail("vector sum: {} bytes added to {} bytes", source.bytes(), target.bytes());
  const int64_t count = target.bytes() / 16;
  program_.use();
  source.bind_storage(0);
  target.bind_storage(1);
  program_.set("count", static_cast<uint32_t>(count));
  program_.dispatch_items(count, 64);
}

}  // namespace relight
