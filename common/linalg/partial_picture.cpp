#include "common/linalg/partial_picture.h"

#include <algorithm>
#include <cmath>

#include "common/run/error.h"

namespace relight {
namespace {

// Of tile_product.glsl; patches of 4x2 fit into it.
constexpr int cell_width = 16, cell_height = 8;

}  // namespace

PartialPicture::PartialPicture(PictureShape shape, std::span<const uint32_t> pixels) {
  const int across = (shape.width + cell_width - 1) / cell_width;
  const auto cell_of = [&](uint32_t pixel) {
    const int x = static_cast<int>(pixel) % shape.width, y = static_cast<int>(pixel) / shape.width;
    return y / cell_height * across + x / cell_width;
  };
  std::vector<int> cells;
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i] >= static_cast<uint64_t>(shape.width) * static_cast<uint64_t>(shape.height))
      fail("partial picture: pixel {} of a picture of {} x {}", pixels[i], shape.width, shape.height);
    if (i > 0 && pixels[i] <= pixels[i - 1]) fail("partial picture: pixel {} is not in order", pixels[i]);
    cells.push_back(cell_of(pixels[i]));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  if (cells.empty()) return;
  // Twice as many cells down as across make it square: no side outgrows a texture.
  const auto count = static_cast<int>(cells.size());
  const int small_across = std::max(1, static_cast<int>(std::ceil(std::sqrt(count / 2.0))));
  small_ = {small_across * cell_width, (count + small_across - 1) / small_across * cell_height};
  pixel_at_.assign(static_cast<size_t>(small_.width) * static_cast<size_t>(small_.height), no_pixel);
  number_at_ = pixel_at_;
  for (uint32_t number = 0; number < pixels.size(); ++number) {
    const auto pixel = static_cast<int>(pixels[number]);
    const auto cell = static_cast<int>(std::lower_bound(cells.begin(), cells.end(), cell_of(pixels[number])) -
                                       cells.begin());
    const int x = cell % small_across * cell_width + pixel % shape.width % cell_width;
    const int y = cell / small_across * cell_height + pixel / shape.width % cell_height;
    const auto place = static_cast<size_t>(y) * static_cast<size_t>(small_.width) + static_cast<size_t>(x);
    pixel_at_[place] = pixels[number];
    number_at_[place] = number;
  }
}

SparseRows PartialPicture::spread(const SparseRows& rows) const {
  SparseRows out;
  out.columns = rows.columns;
  out.row_start.push_back(0);
  out.entries.reserve(rows.entries.size());
  for (const uint32_t number : number_at_) {
    if (number != no_pixel) {
      const std::span<const SparseEntry> row = rows.row(number);
      out.entries.insert(out.entries.end(), row.begin(), row.end());
    }
    out.row_start.push_back(out.entries.size());
  }
  return out;
}

std::vector<glm::vec3> PartialPicture::spread(std::span<const glm::vec3> scale) const {
  std::vector<glm::vec3> out;
  out.reserve(number_at_.size());
  for (const uint32_t number : number_at_)
    out.push_back(number == no_pixel ? glm::vec3(0.0f) : scale[number]);
  return out;
}

}  // namespace relight
