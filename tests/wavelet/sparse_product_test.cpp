// Sparse product: CPU against a dense product, GPU against CPU, in one slab and in many.
#include "common/linalg/sparse_product_gpu.h"

#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {
namespace {

// rows x columns with about a third of the entries; every seventh row empty.
SparseRows random_matrix(size_t rows, uint32_t columns) {
  SparseRows m;
  m.columns = columns;
  m.row_start.push_back(0);
  for (size_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns && r % 7 != 0; ++c)
      if (random_float(3, r, c, 0) < 0.33f) m.entries.push_back({c, random_float(3, r, c, 1) - 0.5f});
    m.row_start.push_back(m.entries.size());
  }
  return m;
}

std::vector<glm::dvec3> random_vector(size_t n) {
  std::vector<glm::dvec3> x(n);
  for (size_t i = 0; i < n; ++i)
    x[i] = glm::dvec3(random_float(4, i, 0, 0), random_float(4, i, 1, 0), random_float(4, i, 2, 0));
  return x;
}

// Red if a row takes a neighbour's entries (off-by-one in row_start) or a channel is dropped.
TEST(SparseRows, MultiplyEqualsTheDenseProduct) {
  const SparseRows m = random_matrix(50, 64);
  const std::vector<glm::dvec3> x = random_vector(64);
  std::vector<std::vector<double>> dense(50, std::vector<double>(64, 0.0));
  for (size_t r = 0; r < 50; ++r)
    for (uint64_t e = m.row_start[r]; e < m.row_start[r + 1]; ++e)
      dense[r][m.entries[e].column] = static_cast<double>(m.entries[e].value);
  const std::vector<glm::vec3> y = multiply(m, x);
  for (size_t r = 0; r < 50; ++r) {
    glm::dvec3 sum(0.0);
    for (size_t c = 0; c < 64; ++c) sum += dense[r][c] * x[c];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(y[r][c]), sum[c], 1e-6);
  }
}

TEST(SparseRows, RefusesAVectorOfTheWrongLength) {
  EXPECT_THROW(multiply(random_matrix(3, 16), random_vector(15)), Error);
}

// Red if a slab forgets its first row, or the row scale is applied with the slab's own row number.
TEST(SparseProductGpu, AgreesWithTheCpuInOneSlabAndInMany) {
  const auto context = gpu::Context::create("osmesa");
  const size_t rows = 500;
  const SparseRows m = random_matrix(rows, 256);
  const std::vector<glm::dvec3> x = random_vector(256);
  std::vector<glm::vec3> scale(rows);
  for (size_t r = 0; r < rows; ++r) scale[r] = glm::vec3(random_float(5, r, 0, 0), 0.5f, 1.0f);
  std::vector<glm::vec4> x4(x.size());
  for (size_t i = 0; i < x.size(); ++i) x4[i] = glm::vec4(glm::vec3(x[i]), 0.0f);
  const gpu::Buffer x_buffer = gpu::Buffer::from(x4);
  const std::vector<glm::vec3> expected = multiply(m, x);
  for (const int64_t block : {int64_t{1} << 27, int64_t{3000}}) {
    const SparseProductGpu product(m, scale, block);
    const gpu::Buffer y(static_cast<int64_t>(rows) * 16);
    product.multiply(x_buffer, y);
    const std::vector<glm::vec4> got = y.download<glm::vec4>();
    // About 85 float products of size <= 0.5 summed in order: error below 85^2/2 x 2^-24 x 0.5.
    for (size_t r = 0; r < rows; ++r)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(got[r][c], expected[r][c] * scale[r][c], 1e-4f) << "row " << r << ", blocks of " << block;
  }
}

TEST(SparseProductGpu, RefusesARowLargerThanAStorageBlock) {
  const auto context = gpu::Context::create("osmesa");
  EXPECT_THROW(SparseProductGpu(random_matrix(10, 256), std::vector<glm::vec3>(10), 64), Error);
}

}  // namespace
}  // namespace relight
