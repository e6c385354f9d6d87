// The forward Haar transform of haar.h on the CPU in float, four channels at once: the fast path of a machine
// without a GPU. haar.h in double is its oracle.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace relight::wavelet {

class HaarCpu {
 public:
  // values: 4^n, else Error. Allocates the scratch memory once.
  explicit HaarCpu(size_t values);
  // Both spans hold one vec4 a value, `values` in tree order; they must not overlap. Sums in the order of
  // haar_step. Parallel; the result does not depend on the number of threads.
  void forward(std::span<const glm::vec4> values, std::span<glm::vec4> coefficients);
  int64_t bytes() const;

 private:
  size_t size_;
  std::vector<glm::vec4> scratch_[2];  // scaling coefficients of every other level
};

}  // namespace relight::wavelet
