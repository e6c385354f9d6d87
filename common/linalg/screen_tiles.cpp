#include "common/linalg/screen_tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

#include "common/linalg/block_culling.h"
#include "common/linalg/pack_weight.h"

namespace relight {
namespace {

// An entry of the matrix within a tile.
struct TileEntry {
  uint32_t column;
  int x, y;  // in the tile
  float weight;
  float response;  // of its pixel
};

std::vector<TileEntry> entries_of_tile(const SparseRows& matrix, std::span<const glm::vec3> scale,
                                       PictureShape shape, int tile) {
  const int x0 = tile % tiles_across(shape) * tile_width, y0 = tile / tiles_across(shape) * tile_height;
  std::vector<TileEntry> entries;
  for (int y = 0; y < std::min(tile_height, shape.height - y0); ++y) {
    for (int x = 0; x < std::min(tile_width, shape.width - x0); ++x) {
      const size_t row =
          static_cast<size_t>(y0 + y) * static_cast<size_t>(shape.width) + static_cast<size_t>(x0 + x);
      for (const SparseEntry& e : matrix.row(row))
        entries.push_back({e.column, x, y, e.value, row_response(scale[row])});
    }
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const TileEntry& a, const TileEntry& b) { return a.column < b.column; });
  return entries;
}

// Appends the block of one column.
void append_block(std::span<const TileEntry> entries, WeightFormat format, TileBlocks& out) {
  int y0 = tile_height, y1 = 0;
  float largest = 0.0f;
  double square = 0.0;
  for (const TileEntry& e : entries) {
    y0 = std::min(y0, e.y), y1 = std::max(y1, e.y);
    largest = std::max(largest, std::abs(e.weight));
    const double v = static_cast<double>(e.weight) * static_cast<double>(e.response);
    square += v * v;
  }
  const int lines = y1 - y0 + 1;
  const float step = quantisation_step(largest, format);
  out.words.insert(
      out.words.end(),
      {entries.front().column << 8 | static_cast<uint32_t>(y0) | static_cast<uint32_t>(lines - 1) << 3,
       std::bit_cast<uint32_t>(step), std::bit_cast<uint32_t>(static_cast<float>(std::sqrt(square))), 0u});
  const size_t first = out.words.size();
  const int weights = lines * tile_width;
  out.words.resize(first + static_cast<size_t>(weights * bytes_of(format)) / 4, 0u);
  for (const TileEntry& e : entries) {
    const int at = (e.y - y0) * tile_width + e.x;
    pack_weight(e.weight / step, format, out.words.data() + first, static_cast<size_t>(at));
  }
  ++out.blocks;
  out.weights += weights;
}

}  // namespace

int tiles_across(PictureShape shape) { return (shape.width + tile_width - 1) / tile_width; }

int tile_count(PictureShape shape) {
  return tiles_across(shape) * ((shape.height + tile_height - 1) / tile_height);
}

TileBlocks make_tile_blocks(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                            int tile, WeightFormat format) {
  const std::vector<TileEntry> entries = entries_of_tile(matrix, scale, shape, tile);
  TileBlocks out;
  for (size_t first = 0; first < entries.size();) {
    size_t last = first;
    while (last < entries.size() && entries[last].column == entries[first].column) ++last;
    append_block(std::span(entries).subspan(first, last - first), format, out);
    first = last;
  }
  return out;
}

}  // namespace relight
