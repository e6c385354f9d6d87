// The list of blocks of a screen tile as 32-bit words, for tile_product.glsl. A block: one word of column (22
// bits) and rectangle, the weights' step, the block's norm, then its weights, four pixels a group, row by
// row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

constexpr int tile_width = 16, tile_height = 8;
constexpr int tile_group = 4;  // pixels side by side: the unit of a rectangle's width
constexpr uint32_t tile_max_columns = 1u << 22;

struct TileBlocks {
  std::vector<uint32_t> words;
  int64_t blocks = 0, weights = 0;  // weights: stored ones, zeros included
};

int tiles_across(PictureShape shape);
int tile_count(PictureShape shape);

// The blocks of tile number `tile`, columns ascending.
TileBlocks make_tile_blocks(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                            int tile, WeightFormat format);

}  // namespace relight
