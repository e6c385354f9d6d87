#include "common/linalg/sparse_product_gpu.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "common/linalg/pack_weight.h"
#include "common/run/error.h"

namespace relight {
namespace {

constexpr uint64_t group = 16;  // entries

// How one group lies in 32-bit words.
struct GroupLayout {
  bool narrow;  // 16-bit columns
  WeightFormat format;
  uint64_t column_words() const { return narrow ? group / 2 : group; }
  uint64_t words() const { return column_words() + group / 4 * static_cast<uint64_t>(bytes_of(format)); }
};

// Writes the groups of one row.
void pack_row(std::span<const SparseEntry> entries, float step, const GroupLayout& layout, uint32_t* out) {
  for (size_t first = 0; first < entries.size(); first += group, out += layout.words()) {
    for (size_t i = 0; i < group; ++i) {
      const size_t e = std::min(first + i, entries.size() - 1);
      pack_column(entries[e].column, layout.narrow, out, i);
      pack_weight(first + i < entries.size() ? entries[e].value / step : 0.0f, layout.format,
                  out + layout.column_words(), i);
    }
  }
}

uint64_t groups_of(const SparseRows& m, size_t row) { return (m.row(row).size() + group - 1) / group; }

}  // namespace

SparseProductGpu::SparseProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale,
                                   int64_t max_block_bytes, WeightFormat format)
    : program_(gpu::Program::compute("common/linalg/sparse_product.glsl",
                                     {matrix.columns <= 65536 ? "COLUMN_BITS 16" : "COLUMN_BITS 32",
                                      fmt::format("WEIGHT_BITS {}", 8 * bytes_of(format))})),
      columns_(matrix.columns),
      non_zeros_(static_cast<int64_t>(matrix.entries.size())) {
  check_sparse_rows(matrix);
  if (scale.size() != matrix.rows())
    fail("sparse product: {} scales for {} rows", scale.size(), matrix.rows());
  const GroupLayout layout{matrix.columns <= 65536, format};
  std::vector<glm::vec4> factor(scale.size());
  const int64_t max_bytes = std::min(max_block_bytes, 16 * gpu::TexelView::max_texels());
  const uint64_t max_groups = static_cast<uint64_t>(max_bytes) / (4 * layout.words());
  for (size_t first = 0; first < matrix.rows();) {
    std::vector<uint32_t> starts{0};
    size_t last = first;
    while (last < matrix.rows() && starts.back() + groups_of(matrix, last) <= max_groups)
      starts.push_back(starts.back() + static_cast<uint32_t>(groups_of(matrix, last++)));
    if (last == first)
      fail("sparse product: row {} has more entries than a buffer of {} bytes holds", first, max_bytes);
    std::vector<uint32_t> words(starts.back() * layout.words());
    tbb::parallel_for(first, last, [&](size_t row) {
      const float step = quantisation_step(matrix.row(row), format);
      factor[row] = glm::vec4(scale[row] * step, 0.0f);
      pack_row(matrix.row(row), step, layout, words.data() + starts[row - first] * layout.words());
    });
    stored_ += static_cast<int64_t>(starts.back() * group);
    gpu::Buffer groups = gpu::Buffer::from(words);
    gpu::TexelView view(groups, gpu::TexelView::Format::rgba32ui);
    slabs_.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(last - first),
                      gpu::Buffer::from(starts), std::move(groups), std::move(view)});
    first = last;
  }
  scale_ = gpu::Buffer::from(factor);
}

void SparseProductGpu::multiply(const gpu::Buffer& x, const gpu::Buffer& y) const {
  check_product_shape(columns_, static_cast<size_t>(scale_.bytes() / 16), static_cast<size_t>(x.bytes() / 16),
                      static_cast<size_t>(y.bytes() / 16));
  program_.use();
  const gpu::TexelView light(x, gpu::TexelView::Format::rgba32f);
  light.bind(2);
  scale_.bind_storage(3);
  y.bind_storage(4);
  for (const Slab& slab : slabs_) {
    slab.group_start.bind_storage(0);
    slab.view.bind(1);
    program_.set("first_row", slab.first_row);
    program_.set("rows", slab.rows);
    program_.dispatch_items(slab.rows, 64);
  }
}

ProductStatistics SparseProductGpu::statistics() const {
  ProductStatistics s;
  s.non_zeros = non_zeros_;
  s.stored = stored_;
  s.bytes = scale_.bytes();
  for (const Slab& slab : slabs_) s.bytes += slab.group_start.bytes() + slab.groups.bytes();
  return s;
}

}  // namespace relight
