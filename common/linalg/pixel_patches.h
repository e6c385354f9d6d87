// The picture cut into patches of eight neighbouring pixels (4x2; 8x1 where the rows are no picture), whose
// matrix rows share one list of columns: blocked compressed rows (BCSR) with blocks of 8x1. Neighbouring
// pixels gather from the same clusters (the final gather shares its cut of the hierarchy among 4x4 pixels),
// so few of the shared weights are zero.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

constexpr int patch_pixels = 8;

// One column of a patch's list and its weight for each pixel, 0 where the pixel's row doesn't have it.
struct PatchColumn {
  uint32_t column;
  std::array<float, patch_pixels> weight;
};

class PixelPatches {
 public:
  static constexpr int64_t no_row = -1;

  // Throws Error unless shape has one pixel for each of `rows` rows.
  PixelPatches(PictureShape shape, size_t rows);
  size_t count() const { return static_cast<size_t>(across_) * static_cast<size_t>(down_); }
  // Matrix row of each pixel of a patch, no_row outside the picture.
  std::array<int64_t, patch_pixels> rows(size_t patch) const;
  // Pixels across a patch: pixel i lies at (i % width, i / width).
  int patch_width() const { return width_; }
  int patches_across() const { return across_; }
  PictureShape shape() const { return shape_; }

 private:
  PictureShape shape_;
  int width_, height_;  // of a patch
  int across_, down_;   // patches
};

// The patch's columns, ascending, each once. `out` is overwritten.
void merge_patch(const SparseRows& m, const std::array<int64_t, patch_pixels>& rows,
                 std::vector<PatchColumn>& out);

// count() + 1 offsets: how many columns the patches before each have. Parallel. Throws Error beyond 2^32.
std::vector<uint32_t> patch_starts(const SparseRows& m, const PixelPatches& patches);

}  // namespace relight
