// The fast float transform against the double-precision one.
#include "common/wavelet/haar_cpu.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "common/sampling/random.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

std::vector<glm::vec4> random_values(size_t n) {
  std::vector<glm::vec4> values;
  for (size_t i = 0; i < n; ++i)
    values.emplace_back(random_float(1, 2, i, 0), random_float(1, 2, i, 1), random_float(1, 2, i, 2), 0.0f);
  return values;
}

// The bound of the GPU's transform: log4(n) levels of additions, each with a relative error of at most a few
// 2^-24. Red if a level reads the wrong scratch buffer or the root forgets coefficient 0.
TEST(HaarCpu, AgreesWithTheDoublePrecisionTransformToFloatRounding) {
  for (const size_t n : {1u, 4u, 16u, 64u, 4096u, 65536u}) {
    const std::vector<glm::vec4> values = random_values(n);
    std::vector<glm::dvec3> oracle(values.begin(), values.end());
    double norm = 0.0;
    for (const glm::dvec3& v : oracle) norm += glm::dot(v, v);
    std::vector<glm::vec4> got(n, glm::vec4(-1.0f));
    HaarCpu(n).forward(values, got);
    const std::vector<glm::dvec3> expected = forward(oracle);
    const double bound = 4.0 * std::log2(static_cast<double>(n) + 1.0) * 0x1p-24 * std::sqrt(norm);
    for (size_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(static_cast<double>(got[i][c]), expected[i][c], bound) << n << " values, index " << i;
  }
}

TEST(HaarCpu, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::vector<glm::vec4> values = random_values(65536);
  std::vector<glm::vec4> one(values.size()), many(values.size());
  HaarCpu haar(values.size());
  {
    const ThreadLimit limit(1);
    haar.forward(values, one);
  }
  const ThreadLimit limit(4);
  haar.forward(values, many);
  EXPECT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(glm::vec4)), 0);
}

TEST(HaarCpu, RefusesOtherSizes) {
  EXPECT_THROW(HaarCpu(8), Error);
  std::vector<glm::vec4> sixteen(16), four(4);
  EXPECT_THROW(HaarCpu(16).forward(sixteen, four), std::logic_error);
}

}  // namespace
}  // namespace relight::wavelet
