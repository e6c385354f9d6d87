// The view cut into tiles of 4x4 pixels: the packets of the final gather.
#pragma once

#include <array>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {

class ViewTiles {
 public:
  static constexpr int side = 4;
  explicit ViewTiles(const DeepFrameBuffer& buffer)
      : buffer_(buffer),
        columns_((buffer.view.width + side - 1) / side),
        rows_((buffer.view.height + side - 1) / side) {}

  int count() const { return columns_ * rows_; }
  // Tile and lane of a pixel.
  size_t tile_of(int x, int y) const { return static_cast<size_t>(y / side * columns_ + x / side); }
  static size_t lane_of(int x, int y) { return static_cast<size_t>(y % side * side + x % side); }

  // Every eighth tile, chosen by hash: enough for means and thresholds over the view.
  std::vector<int> subset(uint64_t seed) const {
    std::vector<int> chosen;
    for (int t = 0; t < count(); ++t)
      if (random_bits(seed, 0xc01a5ca1ull, static_cast<uint64_t>(t), 0) % 8 == 0) chosen.push_back(t);
    return chosen;
  }

  // The tile's view samples by lane; null outside the picture.
  std::array<const SurfaceSample*, lanes> samples(int tile) const {
    std::array<const SurfaceSample*, lanes> out{};
    for (int i = 0; i < lanes; ++i) {
      const int x = tile % columns_ * side + i % side, y = tile / columns_ * side + i / side;
      if (x >= buffer_.view.width || y >= buffer_.view.height) continue;
      out[static_cast<size_t>(i)] =
          &buffer_.indirect[static_cast<size_t>(y) * static_cast<size_t>(buffer_.view.width) +
                            static_cast<size_t>(x)];
    }
    return out;
  }

 private:
  const DeepFrameBuffer& buffer_;
  int columns_, rows_;
};

}  // namespace relight::direct_to_indirect
