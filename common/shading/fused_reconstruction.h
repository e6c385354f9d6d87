// Reconstruction (reconstruction.h) on the CPU in one pass: upsamples indirect light, filters it, adds direct
// light that is filtered already, and checks every pixel. What depends on the view only is two bytes a pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/shading/reconstruction.h"

namespace relight {

class FusedReconstruction {
 public:
  explicit FusedReconstruction(const DeepFrameBuffer& buffer, Upsampling upsampling = Upsampling::closest);

  struct Images {
    Image direct, indirect, total;
  };
  // direct: mean of each pixel's 2x2 sub-samples, in the order of pixel_quad_order (4 pixels a block);
  // indirect: one radiance a value of IndirectSources, row-major. The images equal those
  // of box_filter_2x2 and reconstruct_indirect_cpu bit by bit. Logs stage "reconstruction"; pixels that are
  // not finite are counted (non_finite_reconstruction), warned of and replaced by zero (debug: an Error).
  // Parallel; the result does not depend on the number of threads. Throws std::logic_error if a span is too
  // small.
  Images resolve(std::span<const glm::vec4> direct, std::span<const glm::vec4> indirect, StageLog& log) const;

  // Number of values that `direct` needs.
  size_t direct_values() const { return quads_per_row_ * quad_rows_ * 4; }
  int64_t bytes() const {
    return static_cast<int64_t>(sources_.size() * sizeof(sources_[0]) + own_.size() * sizeof(own_[0]));
  }

 private:
  struct NonFinite;
  // next_own: place in own_ of the first value that the pixel or those after it in the row have of their own.
  glm::vec3 filtered_indirect(std::span<const glm::vec4> indirect, size_t x, size_t y,
                              size_t& next_own) const;
  NonFinite resolve_row(std::span<const glm::vec4> direct, std::span<const glm::vec4> indirect, size_t y,
                        Images& images) const;

  size_t width_, height_, quads_per_row_, quad_rows_;
  Upsampling upsampling_;
  // For each pixel four bits a sub-sample: which of the 3x3 pixels around it (row-major, 4 = itself) it takes
  // its indirect light from; 9: a value of its own; 15: none.
  std::vector<uint16_t> sources_;
  // Places of values that sub-samples have of their own, pixel by pixel; by row of pixels the first of them.
  std::vector<uint32_t> own_;
  std::vector<size_t> first_own_;
  size_t indirect_values_;
};

}  // namespace relight
