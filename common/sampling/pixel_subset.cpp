#include "common/sampling/pixel_subset.h"

#include <algorithm>
#include <set>

#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {
namespace {

constexpr uint64_t stream = 0x5ab5e7ull;
constexpr int side = PixelSubset::side;

size_t index(int x, int y, int width) {
  return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
}

// Calls visit(x, y of the view, x, y of the compact picture) for every pixel inside the view.
template <typename F>
void for_each_pixel(const PixelSubset& subset, F visit) {
  for (size_t t = 0; t < subset.tiles.size(); ++t)
    for (int i = 0; i < side * side; ++i) {
      const int x = subset.tiles[t].x + i % side, y = subset.tiles[t].y + i / side;
      if (x < subset.width && y < subset.height) visit(x, y, static_cast<int>(t) * side + i % side, i / side);
    }
}

}  // namespace

int64_t PixelSubset::pixels() const {
  int64_t count = 0;
  for_each_pixel(*this, [&](int, int, int, int) { ++count; });
  return count;
}

PixelSubset choose_pixels(int width, int height, int64_t pixels, glm::ivec2 block_size, uint64_t seed) {
  if (width < 1 || height < 1) fail("pixel subset: a view of {}x{} has no pixels", width, height);
  if (pixels < 1) fail("pixel subset: {} pixels asked for; at least 1 is needed", pixels);
  if (block_size.x < 1 || block_size.y < 1 || block_size.x % side != 0 || block_size.y % side != 0)
    fail("pixel subset: blocks of {}x{} pixels; valid: multiples of {}", block_size.x, block_size.y, side);
  const int columns = (width + block_size.x - 1) / block_size.x,
            rows = (height + block_size.y - 1) / block_size.y;
  const uint64_t scramble = random_bits(seed, stream, 0, 0);
  PixelSubset subset;
  subset.width = width, subset.height = height;
  std::set<std::pair<int, int>> chosen;  // (row, column) of blocks
  int64_t held = 0;
  for (uint32_t i = 0; held < pixels && chosen.size() < static_cast<size_t>(columns * rows); ++i) {
    const glm::vec2 u = sobol_2d(i, scramble);
    const int column = std::min(static_cast<int>(u.x * static_cast<float>(columns)), columns - 1),
              row = std::min(static_cast<int>(u.y * static_cast<float>(rows)), rows - 1);
    if (!chosen.emplace(row, column).second) continue;
    held += static_cast<int64_t>(std::min(block_size.x, width - column * block_size.x)) *
            std::min(block_size.y, height - row * block_size.y);
  }
  int block = 0;
  for (const auto& [row, column] : chosen) {
    const glm::ivec2 corner = glm::ivec2(column, row) * block_size;
    for (int y = corner.y; y < std::min(corner.y + block_size.y, height); y += side)
      for (int x = corner.x; x < std::min(corner.x + block_size.x, width); x += side) {
        subset.tiles.emplace_back(x, y);
        subset.block.push_back(block);
      }
    ++block;
  }
  return subset;
}

std::vector<uint8_t> pixel_mask(const PixelSubset& subset) {
  std::vector<uint8_t> mask(static_cast<size_t>(subset.width) * static_cast<size_t>(subset.height), 0);
  for_each_pixel(subset, [&](int x, int y, int, int) { mask[index(x, y, subset.width)] = 1; });
  return mask;
}

Image compact(const Image& image, const PixelSubset& subset) {
  Image out(side * static_cast<int>(subset.tiles.size()), side);
  for_each_pixel(subset, [&](int x, int y, int to_x, int to_y) { out.at(to_x, to_y) = image.at(x, y); });
  return out;
}

DeepFrameBuffer compact(const DeepFrameBuffer& buffer, const PixelSubset& subset) {
  DeepFrameBuffer out;
  const int from_width = buffer.view.width, width = side * static_cast<int>(subset.tiles.size());
  out.view = {buffer.view.camera, width, side};
  const auto pixels = static_cast<size_t>(width) * side;
  out.indirect.resize(pixels);
  out.direct.resize(4 * pixels);
  out.edge.assign(pixels, 0);
  out.place.assign(pixels, glm::ivec2(-1));
  out.place_size = {from_width, buffer.view.height};
  for_each_pixel(subset, [&](int x, int y, int to_x, int to_y) {
    out.place[index(to_x, to_y, width)] = {x, y};
    out.indirect[index(to_x, to_y, width)] = buffer.indirect[index(x, y, from_width)];
    out.edge[index(to_x, to_y, width)] = buffer.edge[index(x, y, from_width)];
    for (int s = 0; s < 4; ++s)
      out.direct[index(2 * to_x + s % 2, 2 * to_y + s / 2, 2 * width)] =
          buffer.direct[index(2 * x + s % 2, 2 * y + s / 2, 2 * from_width)];
  });
  return out;
}

std::vector<SurfaceSample> wanted_direct_samples(const DeepFrameBuffer& buffer) {
  std::vector<SurfaceSample> samples = buffer.direct;
  if (buffer.wanted.empty()) return samples;
  const int width = buffer.view.width;
  for (size_t i = 0; i < samples.size(); ++i) {
    const size_t row = i / static_cast<size_t>(2 * width), column = i % static_cast<size_t>(2 * width);
    if (!buffer.wanted[row / 2 * static_cast<size_t>(width) + column / 2]) samples[i].valid = false;
  }
  return samples;
}

}  // namespace relight
