#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "common/sampling/random.h"

namespace relight {
namespace {

// Points first .. first + nx ny - 1 fall into each box of an nx x ny grid exactly once.
bool one_point_a_box(uint32_t first, int nx, int ny, uint64_t scramble) {
  std::vector<int> count(static_cast<size_t>(nx * ny));
  for (uint32_t i = first; i < first + static_cast<uint32_t>(nx * ny); ++i) {
    const glm::vec2 p = sobol_2d(i, scramble);
    ++count[static_cast<size_t>(static_cast<int>(p.y * static_cast<float>(ny)) * nx +
                                static_cast<int>(p.x * static_cast<float>(nx)))];
  }
  for (int c : count)
    if (c != 1) return false;
  return true;
}

// Red if (both tried): the generator matrix of a dimension is wrong, or a bit of the scrambling depends on
// higher ones.
TEST(Sobol, EveryElementaryBoxOfEveryAlignedBlockHoldsOnePoint) {
  for (uint64_t scramble : {0ull, 1ull, 77ull, ~0ull})
    for (uint32_t first : {0u, 256u, 25600u}) {
      EXPECT_TRUE(one_point_a_box(first, 16, 16, scramble)) << scramble << " from " << first;
      EXPECT_TRUE(one_point_a_box(first, 1, 256, scramble)) << scramble << " from " << first;
      EXPECT_TRUE(one_point_a_box(first, 256, 1, scramble)) << scramble << " from " << first;
      EXPECT_TRUE(one_point_a_box(first, 4, 64, scramble)) << scramble << " from " << first;
      EXPECT_TRUE(one_point_a_box(first, 2, 2, scramble)) << scramble << " from " << first;
    }
}

// Red if (tried): `scramble` loses its high bits.
TEST(Sobol, EveryScrambleGivesOtherPoints) {
  std::set<std::pair<float, float>> first_points;
  for (uint64_t bit = 0; bit < 64; ++bit) {
    const glm::vec2 p = sobol_2d(3, 1ull << bit);
    first_points.insert({p.x, p.y});
  }
  EXPECT_EQ(first_points.size(), 64u);
}

// Red if: one point's coordinates aren't uniform over scrambles (estimates would be biased; tried: x halved),
// or x and y of it, or points of two scrambles, are correlated. Bounds are 4.5 standard deviations.
TEST(Sobol, EachPointIsUniformOverScramblesAndIndependentBetweenThem) {
  const int n = 100000;
  double sum_x = 0, sum_y = 0, product = 0, neighbours = 0;
  float previous = 0.5f;
  for (int s = 0; s < n; ++s) {
    const glm::vec2 p = sobol_2d(5, static_cast<uint64_t>(s));
    sum_x += p.x - 0.5, sum_y += p.y - 0.5;
    product += (p.x - 0.5) * (p.y - 0.5);
    neighbours += (p.x - 0.5) * (previous - 0.5);
    previous = p.x;
  }
  const double mean_bound = 4.5 * std::sqrt(1.0 / 12.0 / n),
               product_bound = 4.5 * (1.0 / 12.0) / std::sqrt(n);
  EXPECT_LT(std::abs(sum_x / n), mean_bound);
  EXPECT_LT(std::abs(sum_y / n), mean_bound);
  EXPECT_LT(std::abs(product / n), product_bound);
  EXPECT_LT(std::abs(neighbours / n), product_bound);
}

// Red if (tried): the conversion to float rounds up to 1. Of 2^25 points exactly one lies so near 1 that it
// would.
TEST(Sobol, CoordinatesStayBelowOne) {
  for (uint32_t i = 0; i < 1u << 25; ++i) {
    const glm::vec2 p = sobol_2d(i, 9);
    ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f) << i;
  }
  EXPECT_LT(to_unit_float(~0ull), 1.0f);
}

}  // namespace
}  // namespace relight
