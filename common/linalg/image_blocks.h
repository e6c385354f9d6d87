// A matrix column seen as a picture, the non-zero parts of which are cut into rectangles (Hasan 2006
// section 4.4): start with the tightest rectangle; while the share of zeros in it is above a threshold, split
// it in two where the two tightest rectangles have the smallest area together.
#pragma once

#include <cstdint>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

struct ImageBlock {
  uint32_t column;
  uint16_t x, y, width, height;  // pixels
  int64_t area() const { return int64_t{width} * height; }
};

// The transpose, whose rows are M's columns: entry.column is then M's row, ascending.
SparseRows transpose(const SparseRows& m);

// The blocks of every column of M, given its transpose, in the order of the columns. Each entry lies in
// exactly one block of its column, and no two blocks of a column overlap. block_waste: largest share of
// zeros, 0 to 1. Parallel over columns, deterministic. Throws Error unless the shape has one pixel for each
// row of M and sides below 65,536, and for a block_waste outside [0, 1].
std::vector<ImageBlock> cut_into_blocks(const SparseRows& transposed, PictureShape shape, float block_waste);

// The block's weights, row by row, zero where the column has no entry. `out` is overwritten.
void block_weights(const SparseRows& transposed, PictureShape shape, const ImageBlock& block,
                   std::vector<float>& out);

}  // namespace relight
