// The GLSL transform against the CPU's.
#include "common/wavelet/haar_gpu.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include "common/gpu/context.h"
#include "common/sampling/random.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

// Both sides add the same four floats in the same order, so they agree to a few roundings of the largest
// value. Red if a level reads the wrong ping-pong buffer, or the last level (one node) forgets coefficient 0.
TEST(HaarGpu, AgreesWithTheDoublePrecisionTransformToFloatRounding) {
  const auto context = gpu::Context::create("osmesa");
  for (const size_t n : {4u, 16u, 64u, 4096u, 65536u}) {
    std::vector<glm::vec4> values(n);
    std::vector<glm::dvec3> oracle(n);
    double norm = 0.0;
    for (size_t i = 0; i < n; ++i) {
      values[i] =
          glm::vec4(random_float(1, 2, i, 0), random_float(1, 2, i, 1), random_float(1, 2, i, 2), 0.0f);
      oracle[i] = glm::dvec3(values[i]);
      norm += glm::dot(oracle[i], oracle[i]);
    }
    HaarGpu haar(static_cast<int64_t>(n));
    haar.forward(gpu::Buffer::from(values));
    const std::vector<glm::vec4> got = haar.coefficients().download<glm::vec4>();
    const std::vector<glm::dvec3> expected = forward(oracle);
    // log4(n) levels of additions, each with a relative error of at most a few 2^-24.
    const double bound = 4.0 * std::log2(static_cast<double>(n)) * 0x1p-24 * std::sqrt(norm);
    for (size_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(static_cast<double>(got[i][c]), expected[i][c], bound) << n << " values, index " << i;
  }
}

}  // namespace
}  // namespace relight::wavelet
