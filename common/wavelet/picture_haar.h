// Haar transform over each 4x4 pixels of a picture (two levels of haar.h). Rows of a transport matrix that
// are transformed so store what neighbouring pixels have in common once.
//
// Coefficients lie like the planes of an image: the picture is cut into 4x4 planes, plane (k % 4, k / 4)
// holds coefficient k of every tile, tiles in their order. So neighbours in the picture of coefficients are
// the same coefficient of neighbouring tiles, and forms of the sparse product that count on neighbours being
// alike work on them as they are. Within a tile k follows the pyramid: 0 the scaling coefficient; 1, 4, 5 the
// coarse horizontal, vertical and diagonal details; the fine ones of node (i, j) at (2 + i, j), (i, 2 + j),
// (2 + i, 2 + j).
//
// Tiles that the picture's border cuts, and those that the caller excludes, are not transformed: coefficient
// k is pixel k there, row by row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace relight::wavelet {

constexpr int picture_tile = 4;

// Forward transform of one tile, row by row, in place; orthonormal.
void forward_tile(std::array<float, 16>& values);

class PictureHaar {
 public:
  // transformed: 1 or 0 for each tile of 4x4 pixels, row by row, those cut by the border included. Throws
  // Error on another number of tiles.
  PictureHaar(int width, int height, std::vector<uint8_t> transformed);

  int width() const { return width_; }
  int height() const { return height_; }
  // Is this tile's transform more than a change of places?
  bool transformed(int tile) const { return transformed_[static_cast<size_t>(tile)] != 0; }
  // Of each tile (for the GPU).
  const std::vector<uint8_t>& transformed() const { return transformed_; }
  // Index into the picture of coefficients of coefficient (y % 4) * 4 + x % 4 of the tile around pixel (x,
  // y).
  size_t place(int x, int y) const;
  // For each pixel: factor x the inverse transform. Spans of width x height. Parallel, deterministic.
  void inverse(std::span<const glm::vec4> coefficients, std::span<const glm::vec3> factor,
               std::span<glm::vec4> pixels) const;
  int64_t bytes() const { return static_cast<int64_t>(transformed_.size()); }

 private:
  int width_, height_, across_;
  std::vector<uint8_t> transformed_;
};

}  // namespace relight::wavelet
