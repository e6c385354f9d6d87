#include "common/wavelet/haar_cpu.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

// Nodes a task: below some microseconds of work, waking another thread costs more than it saves.
constexpr size_t grain = 4096;

void analyse(const glm::vec4* source, size_t nodes, glm::vec4* scaling, glm::vec4* coefficients) {
  const auto level = [=](const tbb::blocked_range<size_t>& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const glm::vec4* c = source + 4 * i;
      glm::vec4 details[3];
      scaling[i] = haar_step(c[0], c[1], c[2], c[3], details);
      for (size_t t = 0; t < 3; ++t) coefficients[(t + 1) * nodes + i] = details[t];
    }
  };
  if (nodes <= grain)
    level({0, nodes});
  else
    tbb::parallel_for(tbb::blocked_range<size_t>(0, nodes, grain), level);
}

}  // namespace

HaarCpu::HaarCpu(size_t values) : size_(values), scratch_{} {
  if (!is_power_of_four(static_cast<int64_t>(values)))
    fail("Haar transform: {} values, expected a power of four", values);
  scratch_[0].resize(values / 4);
  scratch_[1].resize(values / 16);
}

void HaarCpu::forward(std::span<const glm::vec4> values, std::span<glm::vec4> coefficients) {
  if (values.size() != size_ || coefficients.size() != size_)
    throw std::logic_error("HaarCpu::forward: not the number of values it was made for");
  const glm::vec4* source = values.data();
  size_t level = 0;
  for (size_t nodes = size_ / 4; nodes > 1; nodes /= 4, ++level) {
    glm::vec4* scaling = scratch_[level % 2].data();
    analyse(source, nodes, scaling, coefficients.data());
    source = scaling;
  }
  if (size_ == 1)
    coefficients[0] = values[0];
  else
    analyse(source, 1, coefficients.data(), coefficients.data());
}

int64_t HaarCpu::bytes() const {
  return static_cast<int64_t>((scratch_[0].size() + scratch_[1].size()) * sizeof(glm::vec4));
}

}  // namespace relight::wavelet
