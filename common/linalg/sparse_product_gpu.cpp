#include "common/linalg/sparse_product_gpu.h"

#include <algorithm>

#include "common/run/error.h"

namespace relight {

SparseProductGpu::SparseProductGpu(const SparseRows& matrix, const std::vector<glm::vec3>& scale,
                                   int64_t max_block_bytes)
    : program_(gpu::Program::compute("common/linalg/sparse_product.glsl")) {
  if (scale.size() != matrix.rows())
    fail("sparse product: {} scales for {} rows", scale.size(), matrix.rows());
  std::vector<glm::vec4> padded(scale.size());
  std::transform(scale.begin(), scale.end(), padded.begin(),
                 [](const glm::vec3& s) { return glm::vec4(s, 0.0f); });
  scale_ = gpu::Buffer::from(padded);

  const uint64_t max_entries = static_cast<uint64_t>(max_block_bytes) / sizeof(SparseEntry);
  for (size_t first = 0; first < matrix.rows();) {
    size_t last = first;
    const uint64_t base = matrix.row_start[first];
    while (last < matrix.rows() && matrix.row_start[last + 1] - base <= max_entries) ++last;
    if (last == first)
      fail("sparse product: row {} has more entries than a storage block of {} bytes holds", first,
           max_block_bytes);
    std::vector<uint32_t> starts(last - first + 1);
    for (size_t r = first; r <= last; ++r)
      starts[r - first] = static_cast<uint32_t>(matrix.row_start[r] - base);
    const uint64_t count = matrix.row_start[last] - base;
    // A buffer of zero bytes cannot be bound: an empty slab still gets one entry's room.
    gpu::Buffer entries(static_cast<int64_t>(std::max<uint64_t>(count, 1) * sizeof(SparseEntry)));
    if (count > 0)
      entries.upload(0, static_cast<int64_t>(count * sizeof(SparseEntry)), matrix.entries.data() + base);
    slabs_.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(last - first),
                      gpu::Buffer::from(starts), std::move(entries)});
    first = last;
  }
}

void SparseProductGpu::multiply(const gpu::Buffer& x, const gpu::Buffer& y) const {
  program_.use();
  x.bind_storage(2);
  scale_.bind_storage(3);
  y.bind_storage(4);
  for (const Slab& slab : slabs_) {
    slab.row_start.bind_storage(0);
    slab.entries.bind_storage(1);
    program_.set("first_row", slab.first_row);
    program_.set("rows", slab.rows);
    program_.dispatch_items(slab.rows, 64);
  }
}

int64_t SparseProductGpu::bytes() const {
  int64_t sum = scale_.bytes();
  for (const Slab& slab : slabs_) sum += slab.row_start.bytes() + slab.entries.bytes();
  return sum;
}

}  // namespace relight
