#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/shading/reconstruction.h"

namespace relight {
namespace {

constexpr uint32_t no_sample = std::numeric_limits<uint32_t>::max();

// How many pixel footprints weigh as much as a unit difference of normals. Equation 9 with its K = 30 gives d
// / 30, which is about 20 pixels in the paper's 640 x 480 images; counted in footprints it holds at any
// resolution and distance.
constexpr float footprints_per_normal = 20.0f;

float squared(const glm::vec3& v) { return glm::dot(v, v); }

// The distance of equation 9 between two visible points, divided by d^2.
float dissimilarity(const SurfaceSample& a, const SurfaceSample& b, float position_scale) {
  return squared((a.position - b.position) * position_scale) + squared(a.shading_normal - b.shading_normal);
}

// K / d of equation 9 for a sample: 1 / (20 footprints of its pixel).
float position_scale(const View& view, const SurfaceSample& sample) {
  const float footprint = pixel_footprint(view, sample);
  return footprint > 0.0f ? 1.0f / (footprints_per_normal * footprint) : 0.0f;
}

// Row-major numbers of the pixels within one of (x, y), the pixel itself first: it wins ties.
template <typename F>
void for_each_neighbour(int x, int y, int width, int height, F visit) {
  const auto number = [width](int px, int py) { return static_cast<uint32_t>(py * width + px); };
  visit(number(x, y));
  for (int py = std::max(y - 1, 0); py <= std::min(y + 1, height - 1); ++py) {
    for (int px = std::max(x - 1, 0); px <= std::min(x + 1, width - 1); ++px) {
      if (px != x || py != y) visit(number(px, py));
    }
  }
}

glm::vec3 filtered(const std::vector<glm::vec3>& values, size_t top, size_t row) {
  return ((values[top] + values[top + 1]) + (values[top + row] + values[top + row + 1])) * 0.25f;
}

}  // namespace

float pixel_footprint(const View& view, const SurfaceSample& sample) {
  const float pixel_angle =
      2.0f * std::tan(glm::radians(view.camera.fov_y_degrees) * 0.5f) / static_cast<float>(view.height);
  return pixel_angle * glm::length(sample.position - view.camera.eye);
}

std::vector<uint32_t> closest_view_samples(const DeepFrameBuffer& buffer) {
  const int width = buffer.view.width, height = buffer.view.height;
  std::vector<uint32_t> closest(buffer.direct.size(), no_sample);
  tbb::parallel_for(tbb::blocked_range<int>(0, 2 * height), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      for (int x = 0; x < 2 * width; ++x) {
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(2 * width) + static_cast<size_t>(x);
        const SurfaceSample& sample = buffer.direct[i];
        if (!sample.valid) continue;
        const float scale = position_scale(buffer.view, sample);
        float best = std::numeric_limits<float>::infinity();
        for_each_neighbour(x / 2, y / 2, width, height, [&](uint32_t pixel) {
          if (!buffer.indirect[pixel].valid) return;
          const float d = dissimilarity(sample, buffer.indirect[pixel], scale);
          if (d < best) best = d, closest[i] = pixel;
        });
      }
    }
  });
  return closest;
}

Image reconstruct_indirect_cpu(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& closest,
                               const std::vector<glm::vec3>& indirect) {
  std::vector<glm::vec3> subsamples(closest.size(), glm::vec3(0.0f));
  for (size_t i = 0; i < closest.size(); ++i) {
    if (closest[i] != no_sample) subsamples[i] = indirect[closest[i]];
  }
  return box_filter_2x2(subsamples, buffer.view.width, buffer.view.height);
}

Image box_filter_2x2(const std::vector<glm::vec3>& subsamples, int width, int height) {
  const size_t row = 2 * static_cast<size_t>(width);
  if (subsamples.size() != row * 2 * static_cast<size_t>(height)) {
    throw std::logic_error("box_filter_2x2: not 2x2 sub-samples a pixel");
  }
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) =
          filtered(subsamples, static_cast<size_t>(y) * 2 * row + 2 * static_cast<size_t>(x), row);
    }
  }
  return image;
}

}  // namespace relight
