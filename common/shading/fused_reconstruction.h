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
  // indirect: one radiance a pixel, or a sub-sample with Upsampling::none, row-major. The images equal those
  // of box_filter_2x2 and reconstruct_indirect_cpu bit by bit. Logs stage "reconstruction"; pixels that are
  // not finite are counted (non_finite_reconstruction), warned of and replaced by zero (debug: an Error).
  // Parallel; the result does not depend on the number of threads. Throws std::logic_error if a span is too
  // small.
  Images resolve(std::span<const glm::vec4> direct, std::span<const glm::vec4> indirect, StageLog& log) const;

  // Number of values that `direct` needs.
  size_t direct_values() const { return quads_per_row_ * quad_rows_ * 4; }
  int64_t bytes() const { return static_cast<int64_t>(sources_.size() * sizeof(sources_[0])); }

 private:
  struct NonFinite;
  glm::vec3 filtered_indirect(std::span<const glm::vec4> indirect, size_t x, size_t y) const;
  NonFinite resolve_row(std::span<const glm::vec4> direct, std::span<const glm::vec4> indirect, size_t y,
                        Images& images) const;

  size_t width_, height_, quads_per_row_, quad_rows_;
  Upsampling upsampling_;
  // For each pixel four bits a sub-sample: which of the 3x3 pixels around it (row-major, 4 = itself) it takes
  // its indirect light from; 15: none.
  std::vector<uint16_t> sources_;
};

}  // namespace relight
