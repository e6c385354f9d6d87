#include "common/linalg/atlas_packing.h"

#include <algorithm>
#include <list>
#include <numeric>
#include <tuple>

#include "common/run/error.h"

namespace relight {
namespace {

struct FreeRectangle {
  int atlas, x, y, width, height;
};

class FreeList {
 public:
  explicit FreeList(int atlas_size) : atlas_size_(atlas_size) {}
  int atlases() const { return atlases_; }

  AtlasPlace take(const AtlasSize& size) {
    auto free = std::find_if(free_.begin(), free_.end(), [&](const FreeRectangle& f) {
      return f.width >= size.width && f.height >= size.height;
    });
    if (free == free_.end()) free = free_.insert(free_.end(), {atlases_++, 0, 0, atlas_size_, atlas_size_});
    const FreeRectangle f = *free;
    free = free_.erase(free);
    // The rest to the right is as high as the block: the next blocks are at most that high.
    if (f.height > size.height)
      free = free_.insert(free, {f.atlas, f.x, f.y + size.height, f.width, f.height - size.height});
    if (f.width > size.width)
      free_.insert(free, {f.atlas, f.x + size.width, f.y, f.width - size.width, size.height});
    return {f.atlas, static_cast<uint16_t>(f.x), static_cast<uint16_t>(f.y)};
  }

 private:
  int atlas_size_, atlases_ = 0;
  std::list<FreeRectangle> free_;
};

}  // namespace

AtlasPacking pack_into_atlases(std::span<const AtlasSize> sizes, int atlas_size) {
  if (atlas_size < 1 || atlas_size > 65536) fail("atlas_size {}: expected 1 to 65536", atlas_size);
  double area = 0.0;
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (std::min(sizes[i].width, sizes[i].height) < 1 ||
        std::max(sizes[i].width, sizes[i].height) > atlas_size)
      fail("atlas packing: block {} of {} x {} texels, atlases of {} a side", i, sizes[i].width,
           sizes[i].height, atlas_size);
    area += static_cast<double>(sizes[i].width) * sizes[i].height;
  }
  std::vector<size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::tuple(-sizes[a].height, -sizes[a].width, a) <
           std::tuple(-sizes[b].height, -sizes[b].width, b);
  });
  AtlasPacking packing;
  packing.places.resize(sizes.size());
  FreeList free(atlas_size);
  for (const size_t i : order) {
    const AtlasPlace place = packing.places[i] = free.take(sizes[i]);
    packing.heights.resize(static_cast<size_t>(free.atlases()), 0);
    int& height = packing.heights[static_cast<size_t>(place.atlas)];
    height = std::max(height, place.y + sizes[i].height);
  }
  const double rows = std::accumulate(packing.heights.begin(), packing.heights.end(), 0.0);
  if (rows > 0.0) packing.fill = area / (rows * atlas_size);
  return packing;
}

}  // namespace relight
