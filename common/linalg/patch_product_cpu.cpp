#include "common/linalg/patch_product_cpu.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "common/linalg/load_weights.h"
#include "common/run/error.h"

namespace relight {
namespace {

constexpr size_t patches_a_task = 64;

// RGB sums of eight pixels, a register a channel.
struct PatchSum {
  __m256 r = _mm256_setzero_ps(), g = _mm256_setzero_ps(), b = _mm256_setzero_ps();
  void add(__m256 weights, const glm::vec4& light) {
    r = _mm256_fmadd_ps(weights, _mm256_broadcast_ss(&light.x), r);
    g = _mm256_fmadd_ps(weights, _mm256_broadcast_ss(&light.y), g);
    b = _mm256_fmadd_ps(weights, _mm256_broadcast_ss(&light.z), b);
  }
};

// Even and odd columns are summed apart: more independent additions in flight.
template <typename Column, typename Weight>
PatchSum patch_sum(const Column* columns, const Weight* weights, size_t count, const glm::vec4* x) {
  PatchSum even, odd;
  size_t i = 0;
  for (; i + 1 < count; i += 2) {
    even.add(load_weights(weights + patch_pixels * i), x[columns[i]]);
    odd.add(load_weights(weights + patch_pixels * (i + 1)), x[columns[i + 1]]);
  }
  if (i < count) even.add(load_weights(weights + patch_pixels * i), x[columns[i]]);
  even.r = _mm256_add_ps(even.r, odd.r);
  even.g = _mm256_add_ps(even.g, odd.g);
  even.b = _mm256_add_ps(even.b, odd.b);
  return even;
}

void write_sums(const PatchSum& sum, const std::array<int64_t, patch_pixels>& rows, const glm::vec4* factor,
                glm::vec4* y) {
  alignas(32) float r[patch_pixels], g[patch_pixels], b[patch_pixels];
  _mm256_store_ps(r, sum.r);
  _mm256_store_ps(g, sum.g);
  _mm256_store_ps(b, sum.b);
  for (size_t i = 0; i < patch_pixels; ++i)
    if (rows[i] != PixelPatches::no_row) y[rows[i]] = glm::vec4(r[i], g[i], b[i], 0.0f) * factor[rows[i]];
}

template <typename Column, typename Weight>
void multiply_patches(const PixelPatches& patches, const std::vector<uint32_t>& start, const Column* columns,
                      const std::byte* weight_bytes, const glm::vec4* factor, const glm::vec4* x,
                      glm::vec4* y) {
  const auto* weights = reinterpret_cast<const Weight*>(weight_bytes);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, patches.count(), patches_a_task), [&](const auto& range) {
    for (size_t p = range.begin(); p < range.end(); ++p) {
      const size_t first = start[p];
      const PatchSum sum =
          patch_sum(columns + first, weights + patch_pixels * first, start[p + 1] - first, x);
      write_sums(sum, patches.rows(p), factor, y);
    }
  });
}

template <typename Column>
void multiply_patches(WeightFormat format, const PixelPatches& patches, const std::vector<uint32_t>& start,
                      const Column* columns, const std::byte* weights, const glm::vec4* factor,
                      const glm::vec4* x, glm::vec4* y) {
  switch (format) {
    case WeightFormat::float32:
      return multiply_patches<Column, float>(patches, start, columns, weights, factor, x, y);
    case WeightFormat::bits16:
      return multiply_patches<Column, int16_t>(patches, start, columns, weights, factor, x, y);
    case WeightFormat::bits8:
      return multiply_patches<Column, int8_t>(patches, start, columns, weights, factor, x, y);
  }
}

}  // namespace

PatchProductCpu::PatchProductCpu(const SparseRows& matrix, std::span<const glm::vec3> row_scale,
                                 PictureShape shape, WeightFormat format)
    : columns_(matrix.columns),
      format_(format),
      non_zeros_(static_cast<int64_t>(matrix.entries.size())),
      patches_(shape, matrix.rows()) {
  check_sparse_rows(matrix);
  if (row_scale.size() != matrix.rows())
    fail("transfer product: {} scales for {} rows", row_scale.size(), matrix.rows());
  start_ = patch_starts(matrix, patches_);
  const bool narrow = columns_ <= 65536;
  (narrow ? narrow_.resize(start_.back()) : wide_.resize(start_.back()));
  weights_.resize(static_cast<size_t>(start_.back()) * patch_pixels * static_cast<size_t>(bytes_of(format)));
  row_factor_.resize(matrix.rows());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, patches_.count(), patches_a_task), [&](const auto& range) {
    std::vector<PatchColumn> merged;
    for (size_t p = range.begin(); p < range.end(); ++p) {
      const auto rows = patches_.rows(p);
      std::array<float, patch_pixels> step;
      for (size_t i = 0; i < patch_pixels; ++i) {
        if (rows[i] == PixelPatches::no_row) continue;
        const auto row = static_cast<size_t>(rows[i]);
        step[i] = quantisation_step(matrix.row(row), format);
        row_factor_[row] = glm::vec4(row_scale[row] * step[i], 0.0f);
      }
      merge_patch(matrix, rows, merged);
      for (size_t c = 0; c < merged.size(); ++c) {
        const size_t at = start_[p] + c;
        if (narrow)
          narrow_[at] = static_cast<uint16_t>(merged[c].column);
        else
          wide_[at] = merged[c].column;
        for (size_t i = 0; i < patch_pixels; ++i)
          store_weight(format, rows[i] == PixelPatches::no_row ? 0.0f : merged[c].weight[i] / step[i],
                       weights_.data(), at * patch_pixels + i);
      }
    }
  });
}

void PatchProductCpu::multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const {
  check_product_shape(columns_, row_factor_.size(), x.size(), y.size());
  if (wide_.empty())
    multiply_patches(format_, patches_, start_, narrow_.data(), weights_.data(), row_factor_.data(), x.data(),
                     y.data());
  else
    multiply_patches(format_, patches_, start_, wide_.data(), weights_.data(), row_factor_.data(), x.data(),
                     y.data());
}

ProductStatistics PatchProductCpu::statistics() const {
  ProductStatistics s;
  s.non_zeros = non_zeros_;
  s.blocks = static_cast<int64_t>(start_.back());
  s.stored = s.blocks * patch_pixels;
  s.bytes = static_cast<int64_t>(start_.size() * sizeof(uint32_t) + narrow_.size() * sizeof(uint16_t) +
                                 wide_.size() * sizeof(uint32_t) + weights_.size() +
                                 row_factor_.size() * sizeof(glm::vec4));
  return s;
}

}  // namespace relight
