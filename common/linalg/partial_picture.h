// Some pixels of a picture laid out as a smaller picture: the cells of 16x8 pixels that hold any of them,
// side by side. Neighbours within a cell stay neighbours, which the forms of the transfer product count on,
// and nothing is stored for the rest of the picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

class PartialPicture {
 public:
  static constexpr uint32_t no_pixel = 0xffffffffu;

  // pixels: row y * width + x of `shape`, ascending. Throws Error on others.
  PartialPicture(PictureShape shape, std::span<const uint32_t> pixels);

  PictureShape shape() const { return small_; }
  // The pixel of the whole picture at each place of the small one; no_pixel where it's none of `pixels`.
  const std::vector<uint32_t>& pixel_at() const { return pixel_at_; }
  // rows, scale: one for each of `pixels`, in their order. Rows of the small picture, empty for no_pixel.
  SparseRows spread(const SparseRows& rows) const;
  std::vector<glm::vec3> spread(std::span<const glm::vec3> scale) const;

 private:
  PictureShape small_;
  std::vector<uint32_t> pixel_at_;
  std::vector<uint32_t> number_at_;  // index into `pixels`, or no_pixel
};

}  // namespace relight
