// Sparse product with RGB elements: CPU against a dense product, GPU against CPU, in one slab and in many;
// sum of two vectors.
#include "common/linalg/sparse_product_rgb_gpu.h"

#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/linalg/vector_sum_gpu.h"
#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {
namespace {

glm::vec3 random_rgb(uint64_t stream, uint64_t index) {
  return {random_float(3, stream, index, 0) - 0.5f, random_float(3, stream, index, 1),
          random_float(3, stream, index, 2)};
}

// rows x columns with about a third of the entries; every seventh row empty.
SparseRowsRgb random_matrix(size_t rows, uint32_t columns) {
  SparseRowsRgb m;
  m.columns = columns;
  m.row_start.push_back(0);
  for (size_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns && r % 7 != 0; ++c)
      if (random_float(3, r, c, 3) < 0.33f) m.entries.push_back({c, random_rgb(r, c)});
    m.row_start.push_back(m.entries.size());
  }
  return m;
}

std::vector<glm::dvec3> random_vector(size_t n) {
  std::vector<glm::dvec3> x;
  for (size_t i = 0; i < n; ++i) x.emplace_back(random_rgb(1000000, i));
  return x;
}

std::vector<glm::vec4> padded(const std::vector<glm::dvec3>& x) {
  std::vector<glm::vec4> out;
  for (const glm::dvec3& v : x) out.emplace_back(glm::vec3(v), 0.0f);
  return out;
}

// Red if a row takes a neighbour's entries or channels are mixed. No mutation tried yet.
TEST(SparseRowsRgb, MultiplyEqualsTheDenseProductChannelByChannel) {
  const SparseRowsRgb m = random_matrix(50, 64);
  const std::vector<glm::dvec3> x = random_vector(64);
  std::vector<std::vector<glm::dvec3>> dense(50, std::vector<glm::dvec3>(64, glm::dvec3(0.0)));
  for (size_t r = 0; r < 50; ++r)
    for (uint64_t e = m.row_start[r]; e < m.row_start[r + 1]; ++e)
      dense[r][m.entries[e].column] = glm::dvec3(m.entries[e].value);
  const std::vector<glm::dvec3> y = multiply(m, x);
  for (size_t r = 0; r < 50; ++r)
    for (int channel = 0; channel < 3; ++channel) {
      double sum = 0.0;
      for (size_t c = 0; c < 64; ++c) sum += dense[r][c][channel] * x[c][channel];
      EXPECT_NEAR(y[r][channel], sum, 1e-12);
    }
}

TEST(SparseRowsRgb, RefusesAVectorOfTheWrongLength) {
  EXPECT_THROW(multiply(random_matrix(3, 16), random_vector(15)), Error);
}

// Red if a slab forgets its first row, or GLSL reads the entry's words in another order. No mutation tried
// yet.
TEST(SparseProductRgbGpu, AgreesWithTheCpuInOneSlabAndInMany) {
  const auto context = gpu::Context::create("osmesa");
  const size_t rows = 500;
  const SparseRowsRgb m = random_matrix(rows, 256);
  const std::vector<glm::dvec3> x = random_vector(256), expected = multiply(m, x);
  const gpu::Buffer x_buffer = gpu::Buffer::from(padded(x));
  for (const int64_t block : {int64_t{1} << 27, int64_t{6000}}) {
    const SparseProductRgbGpu product(m, block);
    const gpu::Buffer y(static_cast<int64_t>(rows) * 16);
    product.multiply(x_buffer, y);
    const std::vector<glm::vec4> got = y.download<glm::vec4>();
    // About 85 float products below 1 summed in order: error below 85^2/2 x 2^-24.
    for (size_t r = 0; r < rows; ++r)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(static_cast<double>(got[r][c]), expected[r][c], 2.2e-4)
            << "row " << r << ", blocks of " << block;
  }
}

TEST(SparseProductRgbGpu, RefusesARowLargerThanAStorageBlock) {
  const auto context = gpu::Context::create("osmesa");
  EXPECT_THROW(SparseProductRgbGpu(random_matrix(10, 256), 64), Error);
}

// Red if the last, incomplete group is left out or the target is overwritten. No mutation tried yet.
TEST(VectorSumGpu, AddsEveryElement) {
  const auto context = gpu::Context::create("osmesa");
  const std::vector<glm::dvec3> a = random_vector(1000);
  std::vector<glm::dvec3> b = a;
  for (glm::dvec3& v : b) v *= 3.0;
  const gpu::Buffer source = gpu::Buffer::from(padded(a)), target = gpu::Buffer::from(padded(b));
  VectorSumGpu().add(source, target);
  const std::vector<glm::vec4> got = target.download<glm::vec4>();
  for (size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(static_cast<double>(got[i][c]), 4.0 * a[i][c], 1e-6);
  EXPECT_THROW(VectorSumGpu().add(gpu::Buffer(16), target), Error);
}

}  // namespace
}  // namespace relight
