// The view samples that get a row of the final-gather matrix: one a pixel (Hasan 2006 section 3.6), with
// upsampling=edges also sub-pixels that match none of them, with none all 2x2 sub-pixels; and, where only
// some pixels are wanted, which of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/run/knobs.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/shading/reconstruction.h"

namespace relight::direct_to_indirect {

class IndirectGrid {
 public:
  // `buffer` must outlive this.
  IndirectGrid(const DeepFrameBuffer& buffer, const KnobValues& knobs);

  Upsampling upsampling() const { return upsampling_; }
  // `indirect` and the size of `view` are those of the grid; nothing else is meant to be read.
  const DeepFrameBuffer& samples() const { return grid_ ? *grid_ : buffer_; }
  // By number in ViewTiles of samples(): 1 = holds a sample that a wanted pixel's light comes from. Whole
  // tiles, because their samples share the cut of the hierarchy. Empty if all pixels are wanted.
  const std::vector<uint8_t>& tiles() const { return tiles_; }
  // Of all tiles, those that are marked [0,1]; 1 if all pixels are wanted.
  double tile_share() const;

 private:
  void mark_tiles(const std::vector<uint32_t>& sources);

  const DeepFrameBuffer& buffer_;
  Upsampling upsampling_;
  std::optional<DeepFrameBuffer> grid_;  // unless it is the view's own
  std::vector<uint8_t> tiles_;
};

}  // namespace relight::direct_to_indirect
