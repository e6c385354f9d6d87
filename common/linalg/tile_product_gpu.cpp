#include "common/linalg/tile_product_gpu.h"

#include <glad/gl.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "common/linalg/screen_tiles.h"
#include "common/run/error.h"

namespace relight {

TileProductGpu::TileProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                               const ProductSettings& settings, int64_t max_block_bytes)
    : shape_(shape),
      columns_(matrix.columns),
      scale_(padded_row_scale(matrix, scale)),
      culling_(matrix, scale, settings),
      program_(gpu::Program::compute("common/linalg/tile_product.glsl",
                                     {fmt::format("WEIGHT_BITS {}", 8 * bytes_of(settings.weights))})) {
  check_picture_shape(shape, matrix.rows());
  if (matrix.columns > tile_max_columns)
    fail("product tiles: {} columns, at most {} fit its blocks", matrix.columns, tile_max_columns);
  std::vector<TileBlocks> tiles(static_cast<size_t>(tile_count(shape)));
  tbb::parallel_for(size_t{0}, tiles.size(), [&](size_t t) {
    tiles[t] = make_tile_blocks(matrix, scale, shape, static_cast<int>(t), settings.weights);
  });
  const auto max_words =
      4 * static_cast<size_t>(std::min(max_block_bytes / 16, gpu::TexelView::max_texels()));
  for (size_t first = 0; first < tiles.size();) {
    std::vector<uint32_t> start{0}, words;
    size_t last = first;
    for (; last < tiles.size() && words.size() + tiles[last].words.size() <= max_words; ++last) {
      words.insert(words.end(), tiles[last].words.begin(), tiles[last].words.end());
      start.push_back(static_cast<uint32_t>(words.size() / 4));
      statistics_.blocks += tiles[last].blocks;
      statistics_.stored += tiles[last].weights;
      tiles[last] = {};
    }
    if (last == first)
      fail("product tiles: tile {} has more blocks than a buffer of {} bytes holds", first, 4 * max_words);
    gpu::Buffer blocks = gpu::Buffer::from(words);
    gpu::TexelView view(blocks, gpu::TexelView::Format::rgba32ui);
    slabs_.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(last - first),
                      gpu::Buffer::from(start), std::move(blocks), std::move(view)});
    statistics_.bytes += slabs_.back().start.bytes() + slabs_.back().blocks.bytes();
    first = last;
  }
  statistics_.non_zeros = static_cast<int64_t>(matrix.entries.size());
  statistics_.bytes += scale_.bytes() + culling_.bytes();
}

void TileProductGpu::multiply(const gpu::Buffer& x, const gpu::Buffer& y) const {
  check_product_shape(columns_, static_cast<size_t>(scale_.bytes() / 16), static_cast<size_t>(x.bytes() / 16),
                      static_cast<size_t>(y.bytes() / 16));
  culling_.begin(x);
  const gpu::TexelView light(x, gpu::TexelView::Format::rgba32f);
  light.bind(2);
  scale_.bind_storage(3);
  y.bind_storage(4);
  program_.set("tiles_across", static_cast<uint32_t>(tiles_across(shape_)));
  program_.set("picture_size",
               glm::uvec2(static_cast<uint32_t>(shape_.width), static_cast<uint32_t>(shape_.height)));
  for (const Slab& slab : slabs_) {
    slab.start.bind_storage(0);
    slab.view.bind(1);
    program_.set("first_tile", slab.first_tile);
    program_.set("tiles", slab.tiles);
    program_.dispatch_items(int64_t{slab.tiles} * tile_height, tile_height);
  }
}

}  // namespace relight
