#include "common/shading/fused_reconstruction.h"
#include "common/finite.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/shading/non_finite_report.h"

namespace relight {
namespace {

constexpr uint32_t nowhere = std::numeric_limits<uint32_t>::max();
constexpr uint16_t all_from_itself = 0x4444;
constexpr unsigned from_own_value = 9, from_nowhere = 15;

// Four-bit code of the pixel `source` as seen from pixel (x, y).
unsigned source_code(uint32_t source, int x, int y, int width) {
  if (source == nowhere) return from_nowhere;
  const int sx = static_cast<int>(source) % width, sy = static_cast<int>(source) / width;
  return static_cast<unsigned>((sy - y + 1) * 3 + (sx - x + 1));
}

}  // namespace

// Counts and first pixels, of the direct and of the indirect image.
struct FusedReconstruction::NonFinite {
  int64_t count[2] = {0, 0};
  size_t first[2] = {std::numeric_limits<size_t>::max(), std::numeric_limits<size_t>::max()};

  void check(int image, glm::vec3& value, size_t pixel) {
    if (finite(value)) return;
    value = glm::vec3(0.0f);
    ++count[image];
    first[image] = std::min(first[image], pixel);
  }
  static NonFinite sum(const NonFinite& a, const NonFinite& b) {
    NonFinite out;
    for (int i = 0; i < 2; ++i)
      out.count[i] = a.count[i] + b.count[i], out.first[i] = std::min(a.first[i], b.first[i]);
    return out;
  }
};

FusedReconstruction::FusedReconstruction(const DeepFrameBuffer& buffer, Upsampling upsampling)
    : width_(static_cast<size_t>(buffer.view.width)),
      height_(static_cast<size_t>(buffer.view.height)),
      quads_per_row_((width_ + 1) / 2),
      quad_rows_((height_ + 1) / 2),
      upsampling_(upsampling),
      sources_(width_ * height_),
      indirect_values_(0) {
  const IndirectSources sources = indirect_sources(buffer, upsampling);
  indirect_values_ = static_cast<size_t>(sources.width) * static_cast<size_t>(sources.height);
  if (upsampling == Upsampling::none) return;
  const int w = buffer.view.width, h = buffer.view.height;
  const size_t pixels = width_ * height_;
  for (int y = 0; y < h; ++y) {
    first_own_.push_back(own_.size());
    for (int x = 0; x < w; ++x) {
      unsigned code = 0;
      for (int sub = 0; sub < 4; ++sub) {
        const int column = 2 * x + sub % 2, row = 2 * y + sub / 2;
        const uint32_t source = sources.of[static_cast<size_t>(row * 2 * w + column)];
        const bool own = source != nowhere && source >= pixels;
        if (own) own_.push_back(source);
        code |= (own ? from_own_value : source_code(source, x, y, w)) << (4 * sub);
      }
      sources_[static_cast<size_t>(y * w + x)] = static_cast<uint16_t>(code);
    }
  }
}

glm::vec3 FusedReconstruction::filtered_indirect(std::span<const glm::vec4> indirect, size_t x, size_t y,
                                                 size_t& next_own) const {
  if (upsampling_ == Upsampling::none) {
    const glm::vec4* top = indirect.data() + 4 * y * width_ + 2 * x;
    const glm::vec4* bottom = top + 2 * width_;
    return glm::vec3(((top[0] + top[1]) + (bottom[0] + bottom[1])) * 0.25f);
  }
  const size_t pixel = y * width_ + x;
  const unsigned code = sources_[pixel];
  const auto of = [&](unsigned sub) {
    const unsigned source = (code >> (4 * sub)) & 15u;
    if (source == from_nowhere) return glm::vec3(0.0f);
    if (source == from_own_value) return glm::vec3(indirect[own_[next_own++]]);
    return glm::vec3(indirect[(y + source / 3 - 1) * width_ + x + source % 3 - 1]);
  };
  if (code == all_from_itself) return glm::vec3(indirect[pixel]);
  const glm::vec3 a = of(0), b = of(1), c = of(2), d = of(3);  // in this order: own values are counted
  return ((a + b) + (c + d)) * 0.25f;
}

FusedReconstruction::NonFinite FusedReconstruction::resolve_row(std::span<const glm::vec4> direct,
                                                                std::span<const glm::vec4> indirect, size_t y,
                                                                Images& images) const {
  NonFinite bad;
  size_t next_own = first_own_.empty() ? 0 : first_own_[y];
  const glm::vec4* row = direct.data() + y / 2 * quads_per_row_ * 4 + y % 2 * 2;
  for (size_t x = 0; x < width_; ++x) {
    const size_t pixel = y * width_ + x;
    glm::vec3 d(row[x / 2 * 4 + x % 2]);
    glm::vec3 n = filtered_indirect(indirect, x, y, next_own);
    bad.check(0, d, pixel);
    bad.check(1, n, pixel);
    images.direct.pixels[pixel] = d;
    images.indirect.pixels[pixel] = n;
    images.total.pixels[pixel] = d + n;
  }
  return bad;
}

FusedReconstruction::Images FusedReconstruction::resolve(std::span<const glm::vec4> direct,
                                                         std::span<const glm::vec4> indirect,
                                                         StageLog& log) const {
  if (direct.size() < direct_values() || indirect.size() < indirect_values_)
    throw std::logic_error("FusedReconstruction::resolve: needs every value of direct and indirect light");
  const StageTimer timer(log, "reconstruction");
  const Image black(static_cast<int>(width_), static_cast<int>(height_));
  Images images{black, black, black};
  const NonFinite bad = tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, height_, 8), NonFinite{},
      [&](const tbb::blocked_range<size_t>& rows, NonFinite found) {
        for (size_t y = rows.begin(); y < rows.end(); ++y)
          found = NonFinite::sum(found, resolve_row(direct, indirect, y, images));
        return found;
      },
      NonFinite::sum);
  const char* const names[2] = {"direct", "indirect"};
  for (int i = 0; i < 2; ++i)
    if (bad.count[i] > 0) report_non_finite_pixels(names[i], bad.count[i], bad.first[i], width_, log);
  return images;
}

}  // namespace relight
