#include "common/linalg/sparse_product_rgb_gpu.h"

#include <algorithm>

#include "common/run/error.h"

namespace relight {

SparseProductRgbGpu::SparseProductRgbGpu(const SparseRowsRgb& matrix, int64_t max_block_bytes)
    : program_(gpu::Program::compute("common/linalg/sparse_product_rgb.glsl")) {
  static_assert(sizeof(SparseEntryRgb) == 16, "an entry is a texel");
  const int64_t max_bytes = std::min(max_block_bytes, 16 * gpu::TexelView::max_texels());
  const uint64_t max_entries = static_cast<uint64_t>(max_bytes) / sizeof(SparseEntryRgb);
  for (size_t first = 0; first < matrix.rows();) {
    size_t last = first;
    while (last < matrix.rows() && matrix.row_start[last + 1] - matrix.row_start[first] <= max_entries)
      ++last;
    if (last == first)
      fail("sparse RGB product: row {} has more entries than a buffer of {} bytes holds", first, max_bytes);
    slabs_.push_back(make_slab(matrix, first, last));
    first = last;
  }
}

// Rows [first, last).
SparseProductRgbGpu::Slab SparseProductRgbGpu::make_slab(const SparseRowsRgb& matrix, size_t first,
                                                         size_t last) {
  const uint64_t base = matrix.row_start[first], count = matrix.row_start[last] - base;
  std::vector<uint32_t> starts(last - first + 1);
  for (size_t r = first; r <= last; ++r)
    starts[r - first] = static_cast<uint32_t>(matrix.row_start[r] - base);
  // A buffer of zero bytes cannot be bound: an empty slab still gets one entry's room.
  gpu::Buffer entries(static_cast<int64_t>(std::max<uint64_t>(count, 1) * sizeof(SparseEntryRgb)));
  if (count > 0)
    entries.upload(0, static_cast<int64_t>(count * sizeof(SparseEntryRgb)), matrix.entries.data() + base);
  gpu::TexelView view(entries, gpu::TexelView::Format::rgba32ui);
  return {static_cast<uint32_t>(first), static_cast<uint32_t>(last - first), gpu::Buffer::from(starts),
          std::move(entries), std::move(view)};
}

void SparseProductRgbGpu::multiply(const gpu::Buffer& x, const gpu::Buffer& y) const {
  program_.use();
  const gpu::TexelView light(x, gpu::TexelView::Format::rgba32f);
  light.bind(2);
  y.bind_storage(3);
  for (const Slab& slab : slabs_) {
    slab.row_start.bind_storage(0);
    slab.view.bind(1);
    program_.set("first_row", slab.first_row);
    program_.set("rows", slab.rows);
    program_.dispatch_items(slab.rows, 64);
  }
}

int64_t SparseProductRgbGpu::bytes() const {
  int64_t sum = 0;
  for (const Slab& slab : slabs_) sum += slab.row_start.bytes() + slab.entries.bytes();
  return sum;
}

}  // namespace relight
