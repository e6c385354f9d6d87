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
  int g0 = tile_width, g1 = 0, y0 = tile_height, y1 = 0;
  float largest = 0.0f;
  double square = 0.0;
  for (const TileEntry& e : entries) {
    g0 = std::min(g0, e.x / tile_group), g1 = std::max(g1, e.x / tile_group);
    y0 = std::min(y0, e.y), y1 = std::max(y1, e.y);
    largest = std::max(largest, std::abs(e.weight));
    const double v = static_cast<double>(e.weight) * static_cast<double>(e.response);
    square += v * v;
  }
  const int across = g1 - g0 + 1, down = y1 - y0 + 1;
  const float step = quantisation_step(largest, format);
  out.words.push_back(entries.front().column << 10 | static_cast<uint32_t>(g0) |
                      static_cast<uint32_t>(across - 1) << 2 | static_cast<uint32_t>(y0) << 4 |
                      static_cast<uint32_t>(down - 1) << 7);
  out.words.push_back(std::bit_cast<uint32_t>(step));
  out.words.push_back(std::bit_cast<uint32_t>(static_cast<float>(std::sqrt(square))));
  const size_t first = out.words.size();
  const int weights = across * down * tile_group;
  out.words.resize(first + static_cast<size_t>(weights * bytes_of(format)) / 4, 0u);
  for (const TileEntry& e : entries) {
    const int at = ((e.y - y0) * across + e.x / tile_group - g0) * tile_group + e.x % tile_group;
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
