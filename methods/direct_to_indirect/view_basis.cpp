#include "methods/direct_to_indirect/view_basis.h"

#include <algorithm>

#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {

static_assert(ViewTiles::side == wavelet::picture_tile,
              "a packet of the final gather is a tile of the basis");

std::optional<wavelet::PictureHaar> view_basis(const IndirectGrid& grid, const KnobValues& knobs) {
  if (knobs.choice("view_basis") != "haar") return std::nullopt;
  const ViewTiles tiles(grid.samples());
  std::vector<uint8_t> full;
  for (int t = 0; t < tiles.count(); ++t)
    full.push_back(
        std::ranges::all_of(tiles.samples(t), [](const SurfaceSample* s) { return s && s->valid; }));
  return wavelet::PictureHaar(grid.samples().view.width, grid.samples().view.height, std::move(full));
}

}  // namespace relight::direct_to_indirect
