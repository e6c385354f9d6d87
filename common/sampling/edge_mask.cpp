#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/sampling/deep_frame_buffer.h"

namespace relight {

namespace {

struct Tolerance {
  float depth, normal_cosine;
};

bool discontinuous(const SurfaceSample& a, const SurfaceSample& b, const Tolerance& tolerance) {
  if (a.valid != b.valid) return true;
  if (!a.valid) return false;
  // Distance from the tangent plane, not difference of depth: a floor seen at a grazing angle is no edge.
  const float from_plane = std::abs(glm::dot(a.geometric_normal, b.position - a.position));
  return from_plane > tolerance.depth * a.depth ||
         glm::dot(a.geometric_normal, b.geometric_normal) < tolerance.normal_cosine;
}

bool edge_at(const DeepFrameBuffer& buffer, int x, int y, const Tolerance& tolerance) {
  const int w = buffer.view.width, h = buffer.view.height;
  const auto pixel = [](int px, int py, int width) {
    return static_cast<size_t>(py) * static_cast<size_t>(width) + static_cast<size_t>(px);
  };
  const SurfaceSample& centre = buffer.indirect[pixel(x, y, w)];
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, h - 1); ++ny)
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, w - 1); ++nx)
      if (discontinuous(centre, buffer.indirect[pixel(nx, ny, w)], tolerance)) return true;
  for (int s = 0; s < 4; ++s)
    if (discontinuous(centre, buffer.direct[pixel(2 * x + s % 2, 2 * y + s / 2, 2 * w)], tolerance))
      return true;
  return false;
}

}  // namespace

std::vector<uint8_t> edge_mask(const DeepFrameBuffer& buffer, float depth_tolerance, float normal_cosine) {
  const Tolerance tolerance{depth_tolerance, normal_cosine};
  const int w = buffer.view.width;
  std::vector<uint8_t> edge(buffer.indirect.size());
  tbb::parallel_for(0, buffer.view.height, [&](int y) {
    for (int x = 0; x < w; ++x)
      edge[static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x)] =
          edge_at(buffer, x, y, tolerance) ? 1 : 0;
  });
  return edge;
}

}  // namespace relight
