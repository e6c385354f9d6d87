// Which values of indirect light there are, and which sub-sample takes which (reconstruction.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "common/shading/reconstruction.h"

namespace relight {
namespace {

constexpr uint32_t no_sample = std::numeric_limits<uint32_t>::max();
constexpr int tile = 4;
// Squared difference of unit normals: 8 degrees. Normals of a surface that is not at an edge differ by less
// from pixel to pixel.
constexpr float largest_normal_difference2 = 0.02f;

bool matches(const SurfaceSample& sample, const SurfaceSample& pixel, float width) {
  const glm::vec3 n = sample.shading_normal - pixel.shading_normal;
  return glm::dot(n, n) <= largest_normal_difference2 &&
         std::abs(glm::dot(sample.position - pixel.position, pixel.geometric_normal)) <= width;
}

// Sub-samples in the order of the view's tiles, so that those that share a tile see much the same.
std::vector<uint32_t> unmatched(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& closest) {
  const int columns = 2 * buffer.view.width, rows = 2 * buffer.view.height;
  std::vector<uint8_t> alone(closest.size(), 0);
  tbb::parallel_for(size_t{0}, closest.size(), [&](size_t i) {
    const SurfaceSample& s = buffer.direct[i];
    if (s.valid)
      alone[i] = closest[i] == no_sample ||
                 !matches(s, buffer.indirect[closest[i]], pixel_footprint(buffer.view, s));
  });
  std::vector<uint32_t> out;
  for (int top = 0; top < rows; top += 2 * tile)
    for (int left = 0; left < columns; left += 2 * tile)
      for (int y = top; y < std::min(top + 2 * tile, rows); ++y)
        for (int x = left; x < std::min(left + 2 * tile, columns); ++x)
          if (alone[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)])
            out.push_back(static_cast<uint32_t>(y * columns + x));
  return out;
}

void give_own_values(const DeepFrameBuffer& buffer, IndirectSources& sources) {
  const std::vector<uint32_t> alone = unmatched(buffer, sources.of);
  if (alone.empty()) return;
  const auto width = static_cast<size_t>(sources.width);
  const size_t first_row = (static_cast<size_t>(sources.height) + tile - 1) / tile * tile;
  // A tile that is cut by the picture's right edge has fewer places; it is left out.
  const size_t whole_tiles = std::max<size_t>(width / tile, 1), lanes_x = std::min<size_t>(width, tile);
  const size_t places = lanes_x * tile;
  for (size_t k = 0; k < alone.size(); ++k) {
    const size_t t = k / places, lane = k % places;
    const size_t x = t % whole_tiles * tile + lane % lanes_x;
    const size_t y = first_row + t / whole_tiles * tile + lane / lanes_x;
    const auto place = static_cast<uint32_t>(y * width + x);
    sources.own.push_back({alone[k], place});
    sources.of[alone[k]] = place;
  }
  const size_t tile_rows = ((alone.size() + places - 1) / places + whole_tiles - 1) / whole_tiles;
  sources.height = static_cast<int>(first_row + tile * tile_rows);
}

}  // namespace

std::vector<SurfaceSample> IndirectSources::samples(const DeepFrameBuffer& buffer) const {
  if (width == 2 * buffer.view.width && height == 2 * buffer.view.height && own.empty()) return buffer.direct;
  std::vector<SurfaceSample> all = buffer.indirect;
  all.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (const Own& o : own) all[o.place] = buffer.direct[o.subsample];
  return all;
}

IndirectSources indirect_sources(const DeepFrameBuffer& buffer, Upsampling upsampling) {
  IndirectSources sources;
  if (upsampling == Upsampling::none) {
    sources.width = 2 * buffer.view.width, sources.height = 2 * buffer.view.height;
    sources.of.assign(buffer.direct.size(), no_sample);
    for (uint32_t i = 0; i < sources.of.size(); ++i)
      if (buffer.direct[i].valid) sources.of[i] = i;
    return sources;
  }
  sources.width = buffer.view.width, sources.height = buffer.view.height;
  sources.of = closest_view_samples(buffer);
  if (upsampling == Upsampling::edges) give_own_values(buffer, sources);
  return sources;
}

}  // namespace relight
