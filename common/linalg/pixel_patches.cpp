#include "common/linalg/pixel_patches.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>
#include <span>

#include "common/run/error.h"

namespace relight {

PixelPatches::PixelPatches(PictureShape shape, size_t rows) : shape_(shape) {
  check_picture_shape(shape, rows);
  width_ = shape.height == 1 ? patch_pixels : patch_pixels / 2;
  height_ = patch_pixels / width_;
  across_ = (shape.width + width_ - 1) / width_;
  down_ = (shape.height + height_ - 1) / height_;
}

std::array<int64_t, patch_pixels> PixelPatches::rows(size_t patch) const {
  const int x0 = static_cast<int>(patch % static_cast<size_t>(across_)) * width_;
  const int y0 = static_cast<int>(patch / static_cast<size_t>(across_)) * height_;
  std::array<int64_t, patch_pixels> out;
  for (int i = 0; i < patch_pixels; ++i) {
    const int x = x0 + i % width_, y = y0 + i / width_;
    const bool inside = x < shape_.width && y < shape_.height;
    out[static_cast<size_t>(i)] = inside ? static_cast<int64_t>(y) * shape_.width + x : no_row;
  }
  return out;
}

void merge_patch(const SparseRows& m, const std::array<int64_t, patch_pixels>& rows,
                 std::vector<PatchColumn>& out) {
  constexpr uint32_t none = std::numeric_limits<uint32_t>::max();
  out.clear();
  std::array<std::span<const SparseEntry>, patch_pixels> rest;
  for (size_t i = 0; i < patch_pixels; ++i)
    if (rows[i] != PixelPatches::no_row) rest[i] = m.row(static_cast<size_t>(rows[i]));
  for (;;) {
    uint32_t next = none;
    for (const auto& r : rest)
      if (!r.empty() && r.front().column < next) next = r.front().column;
    if (next == none) return;
    PatchColumn merged{next, {}};
    for (size_t i = 0; i < patch_pixels; ++i) {
      if (rest[i].empty() || rest[i].front().column != next) continue;
      merged.weight[i] = rest[i].front().value;
      rest[i] = rest[i].subspan(1);
    }
    out.push_back(merged);
  }
}

std::vector<uint32_t> patch_starts(const SparseRows& m, const PixelPatches& patches) {
  std::vector<uint32_t> start(patches.count() + 1, 0);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, patches.count(), 64), [&](const auto& range) {
    std::vector<PatchColumn> merged;
    for (size_t p = range.begin(); p < range.end(); ++p) {
      merge_patch(m, patches.rows(p), merged);
      start[p + 1] = static_cast<uint32_t>(merged.size());
    }
  });
  uint64_t sum = 0;
  for (uint32_t& s : start) {
    sum += s;
    if (sum > std::numeric_limits<uint32_t>::max())
      fail("transfer product: more than 2^32 columns in patches");
    s = static_cast<uint32_t>(sum);
  }
  return start;
}

}  // namespace relight
