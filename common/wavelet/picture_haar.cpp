#include "common/wavelet/picture_haar.h"

#include <tbb/parallel_for.h>

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

constexpr int tile_pixels = picture_tile * picture_tile;

// One of the four children (a, b) of a node.
glm::vec4 child(const glm::vec4& scaling, const glm::vec4& horizontal, const glm::vec4& vertical,
                const glm::vec4& diagonal, int a, int b) {
  return 0.5f * ((scaling + (a ? -horizontal : horizontal)) +
                 ((b ? -vertical : vertical) + (a != b ? -diagonal : diagonal)));
}

// Pixel (x, y) of a tile from its 16 coefficients.
glm::vec4 inverse_at(const std::array<glm::vec4, tile_pixels>& c, int x, int y) {
  const int i = x / 2, j = y / 2;
  const auto at = [&](int column, int row) { return c[static_cast<size_t>(row * picture_tile + column)]; };
  const glm::vec4 node = child(at(0, 0), at(1, 0), at(0, 1), at(1, 1), i, j);
  return child(node, at(2 + i, j), at(i, 2 + j), at(2 + i, 2 + j), x % 2, y % 2);
}

}  // namespace

void forward_tile(std::array<float, 16>& values) {
  std::array<float, tile_pixels> out;
  std::array<float, 4> node;
  for (size_t j = 0; j < 2; ++j)
    for (size_t i = 0; i < 2; ++i) {
      const size_t p = 8 * j + 2 * i;
      float details[3];
      node[2 * j + i] = haar_step(values[p], values[p + 1], values[p + 4], values[p + 5], details);
      out[4 * j + 2 + i] = details[0];
      out[4 * (2 + j) + i] = details[1];
      out[4 * (2 + j) + 2 + i] = details[2];
    }
  float details[3];
  out[0] = haar_step(node[0], node[1], node[2], node[3], details);
  out[1] = details[0], out[4] = details[1], out[5] = details[2];
  values = out;
}

PictureHaar::PictureHaar(int width, int height, std::vector<uint8_t> transformed)
    : width_(width),
      height_(height),
      across_((width + picture_tile - 1) / picture_tile),
      transformed_(std::move(transformed)) {
  const int down = (height + picture_tile - 1) / picture_tile;
  if (transformed_.size() != static_cast<size_t>(across_) * static_cast<size_t>(down))
    fail("Haar transform of a picture: {} tiles for {}x{} pixels, expected {}", transformed_.size(), width,
         height, across_ * down);
  for (int t = 0; t < across_ * down; ++t)
    if ((t % across_ + 1) * picture_tile > width || (t / across_ + 1) * picture_tile > height)
      transformed_[static_cast<size_t>(t)] = 0;
}

size_t PictureHaar::place(int x, int y) const {
  const int planes_across = width_ / picture_tile, planes_down = height_ / picture_tile;
  const bool whole = x < planes_across * picture_tile && y < planes_down * picture_tile;
  const int column = whole ? x % picture_tile * planes_across + x / picture_tile : x;
  const int row = whole ? y % picture_tile * planes_down + y / picture_tile : y;
  return static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
}

void PictureHaar::inverse(std::span<const glm::vec4> coefficients, std::span<const glm::vec3> factor,
                          std::span<glm::vec4> pixels) const {
  const auto width = static_cast<size_t>(width_);
  tbb::parallel_for(0, static_cast<int>(transformed_.size()), [&](int t) {
    const int left = t % across_ * picture_tile, top = t / across_ * picture_tile;
    std::array<glm::vec4, tile_pixels> c{};
    for (int k = 0; k < tile_pixels; ++k) {
      const int x = left + k % picture_tile, y = top + k / picture_tile;
      if (x < width_ && y < height_) c[static_cast<size_t>(k)] = coefficients[place(x, y)];
    }
    for (int k = 0; k < tile_pixels; ++k) {
      const int x = left + k % picture_tile, y = top + k / picture_tile;
      if (x >= width_ || y >= height_) continue;
      const size_t pixel = static_cast<size_t>(y) * width + static_cast<size_t>(x);
      const glm::vec4 value =
          transformed(t) ? inverse_at(c, k % picture_tile, k / picture_tile) : c[static_cast<size_t>(k)];
      pixels[pixel] = glm::vec4(glm::vec3(value) * factor[pixel], 0.0f);
    }
  });
}

}  // namespace relight::wavelet
