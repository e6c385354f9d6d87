#include "common/linalg/sparse_product_cpu.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "common/linalg/load_weights.h"
#include "common/run/error.h"

namespace relight {
namespace {

constexpr uint64_t group = 8;  // entries that one AVX register of floats holds
constexpr size_t rows_a_task = 512;

// The light of two columns side by side.
template <typename Column>
__m256 load_pair(const glm::vec4* x, const Column* columns) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(&x[columns[0]].x)),
                              _mm_loadu_ps(&x[columns[1]].x), 1);
}

// sum of weight * x[column] over the groups of one row, in a fixed order: four partial sums of pairs hide the
// latency of the additions.
template <typename Column, typename Weight>
__m128 row_sum(const Column* columns, const Weight* weights, uint32_t groups, const glm::vec4* x) {
  const __m256i pairs[4] = {
      _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1), _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3),
      _mm256_setr_epi32(4, 4, 4, 4, 5, 5, 5, 5), _mm256_setr_epi32(6, 6, 6, 6, 7, 7, 7, 7)};
  __m256 sum[4] = {_mm256_setzero_ps(), _mm256_setzero_ps(), _mm256_setzero_ps(), _mm256_setzero_ps()};
  for (uint32_t g = 0; g < groups; ++g, columns += group, weights += group) {
    const __m256 w = load_weights(weights);
    for (int p = 0; p < 4; ++p)
      sum[p] = _mm256_fmadd_ps(_mm256_permutevar8x32_ps(w, pairs[p]), load_pair(x, columns + 2 * p), sum[p]);
  }
  const __m256 all = _mm256_add_ps(_mm256_add_ps(sum[0], sum[1]), _mm256_add_ps(sum[2], sum[3]));
  return _mm_add_ps(_mm256_castps256_ps128(all), _mm256_extractf128_ps(all, 1));
}

template <typename Column, typename Weight>
void multiply_rows(const std::vector<uint32_t>& group_start, const Column* columns,
                   const std::byte* weight_bytes, const std::vector<glm::vec4>& factor, const glm::vec4* x,
                   glm::vec4* y) {
  const auto* weights = reinterpret_cast<const Weight*>(weight_bytes);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, factor.size(), rows_a_task), [&](const auto& range) {
    for (size_t row = range.begin(); row < range.end(); ++row) {
      const uint64_t at = group_start[row] * group;
      const __m128 sum = row_sum(columns + at, weights + at, group_start[row + 1] - group_start[row], x);
      alignas(16) glm::vec4 rgb;
      _mm_store_ps(&rgb.x, sum);
      // The sum's w may be anything, even NaN: x's fourth channel is padding.
      y[row] = glm::vec4(glm::vec3(rgb) * glm::vec3(factor[row]), 0.0f);
    }
  });
}

template <typename Column>
void multiply_rows(WeightFormat format, const std::vector<uint32_t>& group_start, const Column* columns,
                   const std::byte* weights, const std::vector<glm::vec4>& factor, const glm::vec4* x,
                   glm::vec4* y) {
  switch (format) {
    case WeightFormat::float32:
      return multiply_rows<Column, float>(group_start, columns, weights, factor, x, y);
    case WeightFormat::bits16:
      return multiply_rows<Column, int16_t>(group_start, columns, weights, factor, x, y);
    case WeightFormat::bits8:
      return multiply_rows<Column, int8_t>(group_start, columns, weights, factor, x, y);
  }
}

}  // namespace

SparseProductCpu::SparseProductCpu(const SparseRows& matrix, std::span<const glm::vec3> row_scale,
                                   WeightFormat format)
    : columns_(matrix.columns), format_(format), non_zeros_(static_cast<int64_t>(matrix.entries.size())) {
  check_sparse_rows(matrix);
  if (row_scale.size() != matrix.rows())
    fail("sparse product: {} scales for {} rows", row_scale.size(), matrix.rows());
  group_start_.assign(1, 0);
  for (size_t row = 0; row < matrix.rows(); ++row) {
    const uint64_t groups =
        group_start_.back() + (matrix.row_start[row + 1] - matrix.row_start[row] + group - 1) / group;
    if (groups > std::numeric_limits<uint32_t>::max())
      fail("sparse product: more than 2^35 entries by row {}", row);
    group_start_.push_back(static_cast<uint32_t>(groups));
  }
  const uint64_t stored = group_start_.back() * group;
  const bool narrow = columns_ <= 65536;
  (narrow ? narrow_.resize(stored) : wide_.resize(stored));
  weights_.resize(stored * static_cast<uint64_t>(bytes_of(format)));
  row_factor_.resize(matrix.rows());
  tbb::parallel_for(size_t{0}, matrix.rows(), [&](size_t row) {
    const std::span<const SparseEntry> entries = matrix.row(row);
    const float step = quantisation_step(entries, format);
    row_factor_[row] = glm::vec4(row_scale[row] * step, 0.0f);
    const uint64_t first = group_start_[row] * group, last = group_start_[row + 1] * group;
    for (uint64_t at = first; at < last; ++at) {
      const uint64_t e = std::min<uint64_t>(at - first, entries.size() - 1);
      const float value = at - first < entries.size() ? entries[e].value / step : 0.0f;
      store_weight(format, value, weights_.data(), at);
      if (narrow)
        narrow_[at] = static_cast<uint16_t>(entries[e].column);
      else
        wide_[at] = entries[e].column;
    }
  });
}

void SparseProductCpu::multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const {
  check_product_shape(columns_, rows(), x.size(), y.size());
  if (wide_.empty())
    multiply_rows(format_, group_start_, narrow_.data(), weights_.data(), row_factor_, x.data(), y.data());
  else
    multiply_rows(format_, group_start_, wide_.data(), weights_.data(), row_factor_, x.data(), y.data());
}

ProductStatistics SparseProductCpu::statistics() const {
  ProductStatistics s;
  s.non_zeros = non_zeros_;
  s.stored = static_cast<int64_t>(group_start_.back() * group);
  s.bytes = static_cast<int64_t>(group_start_.size() * sizeof(uint32_t) + narrow_.size() * sizeof(uint16_t) +
                                 wide_.size() * sizeof(uint32_t) + weights_.size() +
                                 row_factor_.size() * sizeof(glm::vec4));
  return s;
}

}  // namespace relight
