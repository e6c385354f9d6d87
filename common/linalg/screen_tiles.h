// The list of blocks of a screen tile as texels of four 32-bit words, for tile_product.glsl. A block: a texel
// of column (24 bits), first line and lines less one, the weights' step, the block's norm and a zero; then
// its weights, whole lines of the tile. Whole lines, because a texel is what a software rasteriser reads
// fastest: a line of 8-bit weights is exactly one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

constexpr int tile_width = 16, tile_height = 8;
constexpr uint32_t tile_max_columns = 1u << 24;

struct TileBlocks {
  std::vector<uint32_t> words;      // four a texel
  int64_t blocks = 0, weights = 0;  // weights: stored ones, zeros included
};

int tiles_across(PictureShape shape);
int tile_count(PictureShape shape);

// The blocks of tile number `tile`, columns ascending.
TileBlocks make_tile_blocks(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                            int tile, WeightFormat format);

}  // namespace relight
