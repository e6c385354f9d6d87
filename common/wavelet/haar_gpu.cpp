#include "common/wavelet/haar_gpu.h"

#include <algorithm>

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {

HaarGpu::HaarGpu(int64_t values)
    : size_(values),
      program_(gpu::Program::compute("common/wavelet/haar_level.glsl")),
      ping_(std::max<int64_t>(values / 4, 1) * 16),
      pong_(std::max<int64_t>(values / 16, 1) * 16),
      coefficients_(values * 16) {
  if (!is_power_of_four(values) || values < 4)
    fail("Haar transform: {} values, expected a power of four, at least 4", values);
}

void HaarGpu::forward(const gpu::Buffer& values) const {
  program_.use();
  coefficients_.bind_storage(2);
  const gpu::Buffer* source = &values;
  bool to_ping = true;
  for (int64_t nodes = size_ / 4; nodes >= 1; nodes /= 4) {
    const gpu::Buffer& target = to_ping ? ping_ : pong_;
    source->bind_storage(0);
    target.bind_storage(1);
    program_.set("nodes", static_cast<uint32_t>(nodes));
    program_.dispatch_items(nodes, 64);
    source = &target;
    to_ping = !to_ping;
  }
}

int64_t HaarGpu::bytes() const { return ping_.bytes() + pong_.bytes() + coefficients_.bytes(); }

}  // namespace relight::wavelet
