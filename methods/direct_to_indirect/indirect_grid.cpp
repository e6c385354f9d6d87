#include "methods/direct_to_indirect/indirect_grid.h"

#include <algorithm>
#include <limits>

#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {

namespace {

Upsampling upsampling_of(const KnobValues& knobs) {
  const std::string& name = knobs.choice("upsampling");
  return name == "none" ? Upsampling::none : name == "edges" ? Upsampling::edges : Upsampling::closest;
}

}  // namespace

IndirectGrid::IndirectGrid(const DeepFrameBuffer& buffer, const KnobValues& knobs)
    : buffer_(buffer), upsampling_(upsampling_of(knobs)) {
  if (upsampling_ == Upsampling::closest && buffer.wanted.empty()) return;
  const IndirectSources sources = indirect_sources(buffer, upsampling_);
  if (upsampling_ != Upsampling::closest) {
    grid_.emplace();
    grid_->view = {buffer.view.camera, sources.width, sources.height};
    grid_->indirect = sources.samples(buffer);
  }
  if (!buffer.wanted.empty()) mark_tiles(sources.of);
}

double IndirectGrid::tile_share() const {
  if (tiles_.empty()) return 1.0;
  return static_cast<double>(std::count(tiles_.begin(), tiles_.end(), 1)) /
         static_cast<double>(tiles_.size());
}

void IndirectGrid::mark_tiles(const std::vector<uint32_t>& sources) {
  const ViewTiles tiles(samples());
  tiles_.assign(static_cast<size_t>(tiles.count()), 0);
  const auto width = static_cast<size_t>(buffer_.view.width);
  const auto grid_width = static_cast<uint32_t>(samples().view.width);
  for (size_t i = 0; i < sources.size(); ++i) {
    const size_t x = i % (2 * width) / 2, y = i / (2 * width) / 2;
    if (!buffer_.wanted[y * width + x] || sources[i] == std::numeric_limits<uint32_t>::max()) continue;
    tiles_[tiles.tile_of(static_cast<int>(sources[i] % grid_width),
                         static_cast<int>(sources[i] / grid_width))] = 1;
  }
}

}  // namespace relight::direct_to_indirect
