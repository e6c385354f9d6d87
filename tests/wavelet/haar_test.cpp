// Haar transform against a dense matrix built from the definition, and against identities that any
// orthonormal basis obeys.
#include "common/wavelet/haar.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight::wavelet {
namespace {

std::vector<double> random_values(size_t n) {
  std::vector<double> v(n);
  for (size_t i = 0; i < n; ++i) v[i] = random_float(7, 1, i, 0) * 2.0 - 1.0;
  return v;
}

// Coordinates of position `index` on the Morton curve.
void morton(uint32_t index, uint32_t& x, uint32_t& y) {
  x = y = 0;
  for (uint32_t b = 0; b < 16; ++b) {
    x |= (index >> (2 * b) & 1u) << b;
    y |= (index >> (2 * b + 1) & 1u) << b;
  }
}

// Value at texel (x, y) of basis function `index` for a side x side array, from its definition: on its square
// support of side s at (i s, j s) it is +-1/s, with the sign pattern of horizontal, vertical or diagonal
// halves.
double basis(uint32_t index, uint32_t x, uint32_t y, uint32_t side) {
  if (index == 0) return 1.0 / side;
  uint32_t nodes = 1;
  while (nodes * 4 <= index) nodes *= 4;
  const uint32_t type = index / nodes, node = index % nodes;
  uint32_t per_side = 1;
  while (per_side * per_side < nodes) per_side *= 2;
  const uint32_t s = side / per_side;
  uint32_t i, j;
  morton(node, i, j);
  if (x / s != i || y / s != j) return 0.0;
  const double h = x % s < s / 2 ? 1.0 : -1.0, v = y % s < s / 2 ? 1.0 : -1.0;
  return (type == 1 ? h : type == 2 ? v : h * v) / s;
}

// Red if a sign, a factor or an index of haar_step or of the coefficient layout is wrong.
TEST(Haar, ForwardEqualsTheDenseBasisMatrix) {
  for (const uint32_t side : {1u, 2u, 4u, 8u, 16u}) {
    const uint32_t n = side * side;
    const std::vector<double> values = random_values(n), got = forward(values);
    for (uint32_t c = 0; c < n; ++c) {
      double expected = 0.0;
      for (uint32_t p = 0; p < n; ++p) {
        uint32_t x, y;
        morton(p, x, y);
        expected += basis(c, x, y, side) * values[p];
      }
      EXPECT_NEAR(got[c], expected, 1e-13) << "coefficient " << c << " of " << n;
    }
  }
}

// Red if the transform is scaled (a factor 1/2 on one level only would still pass an inverse(forward(x))
// test).
TEST(Haar, KeepsTheNormAsParsevalSays) {
  const std::vector<double> values = random_values(4096), c = forward(values);
  double before = 0.0, after = 0.0;
  for (size_t i = 0; i < values.size(); ++i) before += values[i] * values[i], after += c[i] * c[i];
  EXPECT_NEAR(after, before, 1e-10 * before);
}

// Red if the in-place order of the inverse overwrites a parent that is still needed.
TEST(Haar, InverseUndoesForward) {
  const std::vector<double> values = random_values(1024), back = inverse(forward(values));
  for (size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(back[i], values[i], 1e-13);
}

// Red if support() is off by a level: the count of non-zeros of each basis function is its definition.
TEST(Haar, SupportCountsTheNonZerosOfTheBasisFunction) {
  const uint32_t n = 256;
  for (uint32_t c = 0; c < n; ++c) {
    std::vector<double> spike(n, 0.0);
    spike[c] = 1.0;
    uint32_t non_zero = 0;
    for (const double v : inverse(spike)) non_zero += v != 0.0;
    EXPECT_EQ(support(c, n), non_zero) << "coefficient " << c;
  }
}

TEST(Haar, RefusesSizesThatAreNoPowerOfFour) {
  for (const size_t n : {2u, 3u, 8u, 60u}) EXPECT_THROW(forward(std::vector<double>(n)), Error) << n;
  EXPECT_FALSE(is_power_of_four(0));
  EXPECT_FALSE(is_power_of_four(-4));
  EXPECT_TRUE(is_power_of_four(1));
  EXPECT_TRUE(is_power_of_four(65536));
}

}  // namespace
}  // namespace relight::wavelet
