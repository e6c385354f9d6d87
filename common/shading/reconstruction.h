// From one indirect value a pixel and 2x2 direct values a pixel to the final image (Hasan 2006 section 3.6):
// each sub-sample takes the indirect value of the closest view sample (by normal and position) in the 3x3
// pixels around it, then a 2x2 box filter.
#pragma once

#include <cstdint>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/image/image.h"
#include "common/sampling/deep_frame_buffer.h"

namespace relight {

// Where sub-samples have their indirect light from: `closest`, the paper's, one value a pixel; `edges`, also
// a value of their own for those that match no pixel around them; `none`, the exact twin, one value each.
enum class Upsampling { closest, edges, none };

// Width of a pixel at the sample's distance from the eye, across the direction of view.
float pixel_footprint(const View& view, const SurfaceSample& sample);

// For each of the 2w x 2h sub-samples: index of the view sample whose indirect value it takes; 0xffffffff
// where the sub-sample hit nothing, or all 3x3 view samples did. "Closest" has the form of equation 9:
// |p-p'|^2 / (20 f)^2 + |n-n'|^2 with shading normals and f the width of a pixel at the sample's distance;
// the own pixel wins ties. Depends on the view only. Parallel, deterministic.
std::vector<uint32_t> closest_view_samples(const DeepFrameBuffer& buffer);

// The values of indirect light and who takes which. They are a picture, so that neighbours lie in one 4x4
// tile: the pixels of the view, with `edges` more rows below, with `none` the sub-samples.
struct IndirectSources {
  int width = 0, height = 0;
  std::vector<uint32_t> of;  // by sub-sample: place of its value in the picture, 0xffffffff if it hit nothing
  // With `edges`: sub-samples with a value of their own, and its place. Four rows after the other, sixteen in
  // each 4x4 tile, in the order of the view's tiles; the first row is a multiple of four.
  struct Own {
    uint32_t subsample, place;
  };
  std::vector<Own> own;
  // The view samples of the picture; what is left over is not valid.
  std::vector<SurfaceSample> samples(const DeepFrameBuffer& buffer) const;
};

// A sub-sample matches no pixel if none around it is valid, or if the closest one's shading normal differs by
// more than 8 degrees or it lies off that one's plane by more than a pixel's width. Depends on the view only.
// Parallel, deterministic.
IndirectSources indirect_sources(const DeepFrameBuffer& buffer, Upsampling upsampling);

// CPU twin. indirect: one radiance a pixel. Returns the box-filtered indirect image.
Image reconstruct_indirect_cpu(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& closest,
                               const std::vector<glm::vec3>& indirect);

// Box filter over each pixel's 2x2 sub-samples.
Image box_filter_2x2(const std::vector<glm::vec3>& subsamples, int width, int height);

// The same on the GPU, equal bit by bit; logs stage "reconstruction". Needs a current context.
class Reconstruction {
 public:
  explicit Reconstruction(const DeepFrameBuffer& buffer, Upsampling upsampling = Upsampling::closest);
  int64_t bytes() const { return closest_.bytes() + direct_image_.bytes() + indirect_image_.bytes(); }
  // direct: vec4 a sub-sample; indirect: vec4 a value of IndirectSources. Downloads both
  // filtered images. Pixels that are not finite are counted (non_finite_reconstruction), warned of and
  // replaced by zero (debug: an Error).
  struct Images {
    Image direct, indirect;
  };
  Images resolve(const gpu::Buffer& direct, const gpu::Buffer& indirect, class StageLog& log) const;

 private:
  Reconstruction(const DeepFrameBuffer& buffer, const IndirectSources& sources);
  int width_, height_;
  int64_t indirect_values_;
  gpu::Buffer closest_;
  gpu::Program program_;
  gpu::Buffer direct_image_, indirect_image_;
};

}  // namespace relight
