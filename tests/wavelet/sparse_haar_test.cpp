// The sparse Haar transform against the dense one.
#include "common/wavelet/sparse_haar.h"

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

// About `share` of n values, the first and the last among them.
std::vector<SparseValue> random_values(uint32_t n, float share) {
  std::vector<SparseValue> values;
  for (uint32_t i = 0; i < n; ++i)
    if (i == 0 || i == n - 1 || random_float(5, n, i, 0) < share)
      values.push_back({i, {random_float(5, n, i, 1), random_float(5, n, i, 2) - 0.5f, 0.0f}});
  return values;
}

// Red if a child goes to the wrong quarter, a level's offset is wrong or a lone child is dropped. No mutation
// tried yet.
TEST(SparseHaar, EqualsTheDenseTransform) {
  for (const uint32_t n : {1u, 4u, 64u, 4096u})
    for (const float share : {0.001f, 0.1f, 1.0f}) {
      std::vector<SparseValue> values = random_values(n, share), got;
      std::vector<glm::vec3> dense(n, glm::vec3(0.0f));
      for (const SparseValue& v : values) dense[v.index] = v.value;
      const std::vector<glm::vec3> expected = forward(dense);
      forward_sparse(values, n, got);
      std::vector<glm::vec3> scattered(n, glm::vec3(0.0f));
      for (const SparseValue& c : got) {
        EXPECT_EQ(scattered[c.index], glm::vec3(0.0f)) << "coefficient " << c.index << " twice";
        EXPECT_NE(c.value, glm::vec3(0.0f));
        scattered[c.index] = c.value;
      }
      // The same steps on the same floats, zeros included: the same bits.
      for (uint32_t i = 0; i < n; ++i) ASSERT_EQ(scattered[i], expected[i]) << i << " of " << n;
    }
}

// One value out of a million: three details a level and the scaling coefficient. Red if the transform walks
// all nodes.
TEST(SparseHaar, OneValueGivesThreeCoefficientsALevel) {
  const uint32_t n = 1u << 20;
  std::vector<SparseValue> values = {{123456, glm::vec3(1.0f)}}, got;
  forward_sparse(values, n, got);
  EXPECT_EQ(got.size(), 1u + 3u * 10u);
}

TEST(SparseHaar, RefusesASizeThatIsNoPowerOfFour) {
  std::vector<SparseValue> values, got;
  EXPECT_THROW(forward_sparse(values, 8, got), Error);
}

}  // namespace
}  // namespace relight::wavelet
