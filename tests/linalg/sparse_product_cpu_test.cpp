// The row-based CPU product against the double-precision oracle.
#include "common/linalg/sparse_product_cpu.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "common/run/error.h"
#include "tests/linalg/product_check.h"

namespace relight {
namespace {

constexpr WeightFormat formats[] = {WeightFormat::float32, WeightFormat::bits16, WeightFormat::bits8};

std::vector<glm::vec4> product(const SparseRows& m, const std::vector<glm::vec4>& x, WeightFormat format) {
  std::vector<glm::vec4> y(m.rows(), glm::vec4(-1.0f));
  SparseProductCpu(m, check::random_scale(m.rows()), format).multiply(x, y);
  return y;
}

// Row lengths around the group of eight, columns narrow and wide (the second matrix has 70,000). Tried:
// columns of a wide matrix stored in 16 bits; the first group left out; pairs 2 and 3 of a group swapped;
// weights truncated instead of rounded. Each is red.
TEST(SparseProductCpu, EveryFormatIsWithinItsBoundOfTheOracle) {
  for (const auto& [columns, density] : {std::pair{200u, 0.3f}, {70000u, 0.0005f}, {1u, 0.5f}, {17u, 0.9f}}) {
    const SparseRows m = check::random_matrix(300, columns, density);
    const std::vector<glm::vec4> x = check::random_light(columns);
    for (const WeightFormat format : formats) {
      SCOPED_TRACE(std::to_string(columns) + " columns, " + to_string(format));
      check::expect_product(m, x, check::random_scale(300), product(m, x, format),
                            check::row_steps(m, format));
    }
  }
}

// y holds the first result when it is computed again: a sum that starts from y's old value would be red. (No
// mutation was tried.)
TEST(SparseProductCpu, SameBitsForAnyNumberOfThreadsAndRepeats) {
  const SparseRows m = check::image_like_matrix(60, 40, 300, 30);
  const std::vector<glm::vec4> x = check::random_light(300);
  for (const WeightFormat format : formats) {
    const SparseProductCpu p(m, check::random_scale(m.rows()), format);
    std::vector<glm::vec4> y(m.rows());
    p.multiply(x, y);
    for (const size_t threads : {1u, 2u, 7u}) {
      oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
      std::vector<glm::vec4> again = y;
      p.multiply(x, again);
      EXPECT_EQ(std::memcmp(y.data(), again.data(), y.size() * sizeof(glm::vec4)), 0)
          << threads << " threads";
    }
  }
}

// Tried: filling the last group up with column 0 spreads the NaN to rows that don't have that column.
TEST(SparseProductCpu, NonFiniteLightReachesExactlyTheRowsThatHaveItsColumn) {
  const SparseRows m = check::random_matrix(100, 40, 0.2f);
  std::vector<glm::vec4> x = check::random_light(40);
  for (const uint32_t column : {0u, 23u}) {
    x[column].x = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec4> y = product(m, x, WeightFormat::bits8);
    for (size_t r = 0; r < m.rows(); ++r) {
      bool has = false;
      for (const SparseEntry& e : m.row(r)) has = has || e.column == column;
      EXPECT_EQ(std::isnan(y[r].x), has) << "row " << r << ", column " << column;
      EXPECT_TRUE(std::isfinite(y[r].y) && y[r].w == 0.0f) << "row " << r;
    }
    x[column].x = 1.0f;
  }
}

// A quantised NaN would be some integer. Tried: no check_sparse_rows in the constructor is red.
TEST(SparseProductCpu, RefusesWhatItCannotStore) {
  SparseRows m = check::random_matrix(10, 20, 0.5f);
  const std::vector<glm::vec3> scale(10);
  EXPECT_THROW(SparseProductCpu(m, std::vector<glm::vec3>(9), WeightFormat::bits8), Error);
  const SparseProductCpu p(m, scale, WeightFormat::bits8);
  std::vector<glm::vec4> x(20), y(10);
  EXPECT_THROW(p.multiply(std::span(x).first(19), y), Error);
  EXPECT_THROW(p.multiply(x, std::span(y).first(9)), Error);
  m.entries[5].value = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(SparseProductCpu(m, scale, WeightFormat::bits8), Error);
  m.entries[5] = {20, 1.0f};
  EXPECT_THROW(SparseProductCpu(m, scale, WeightFormat::float32), Error);
}

// No rows, empty rows, rows of zeros and denormals. Tried: a step of 0 for such rows stays green, because the
// row's factor is 0 then; the forms by blocks are tested for it in tests/hard_cases.
TEST(SparseProductCpu, MatricesWithNothingToMultiplyGiveZero) {
  SparseRows none;
  EXPECT_NO_THROW(SparseProductCpu(none, {}, WeightFormat::bits8).multiply({}, {}));
  SparseRows m;
  m.columns = 3;
  m.row_start = {0, 0, 1, 3};
  m.entries = {{1, 0.0f}, {0, 1e-44f}, {2, 0.0f}};
  const std::vector<glm::vec4> x(3, glm::vec4(2.0f));
  for (const WeightFormat format : formats)
    for (const glm::vec4& y : product(m, x, format)) EXPECT_NEAR(y.x, 0.0f, 1e-37f) << to_string(format);
}

TEST(WeightFormat, UnknownNamesFailWithTheValidOnes) {
  for (const WeightFormat format : formats) EXPECT_EQ(weight_format_from_string(to_string(format)), format);
  try {
    weight_format_from_string("12");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "weight format '12': expected float32, 16 or 8");
  }
}

}  // namespace
}  // namespace relight
