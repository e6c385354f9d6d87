// A few pixels of a view that stand for all of them: where an exact computation is too slow for the whole
// picture.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "common/image/image.h"
#include "common/sampling/deep_frame_buffer.h"

namespace relight {

struct PixelSubset {
  static constexpr int side = 4;  // of a tile: the packets of methods and reference
  int width = 0, height = 0;      // of the view
  std::vector<glm::ivec2> tiles;  // upper left pixels, row by row; tiles at the rim may reach beyond it
  std::vector<int> block;         // by tile: the block that it came with; blocks are independent
  int64_t pixels() const;         // inside the view
};

// Blocks of block_size pixels (multiples of 4), spread over the view by a Sobol sequence that `seed`
// scrambles, until they hold at least `pixels`, or all of the view. Deterministic. Throws Error for sizes out
// of range.
PixelSubset choose_pixels(int width, int height, int64_t pixels, glm::ivec2 block_size, uint64_t seed);

// width x height: 1 for the pixels of the subset.
std::vector<uint8_t> pixel_mask(const PixelSubset& subset);

// The tiles side by side as a picture of 4 tiles x 4 pixels. Beyond the rim of the view: black, not valid, no
// edge. The buffer's view keeps its camera; `wanted` is empty.
Image compact(const Image& image, const PixelSubset& subset);
DeepFrameBuffer compact(const DeepFrameBuffer& buffer, const PixelSubset& subset);

// The 2x2 sub-samples of the pixels that the buffer asks for; the others are not valid.
std::vector<SurfaceSample> wanted_direct_samples(const DeepFrameBuffer& buffer);

}  // namespace relight
