// Surface samples as structure of arrays, in blocks of 16 neighbours: the form that direct lighting on the
// CPU reads (block_lighting.h). Sixteen is the width of a shadow-ray packet and two AVX2 registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/surface_sample.h"
#include "common/shading/block_bounds.h"

namespace relight {

constexpr size_t block_lanes = 16;

// Lane i of each array is one sample; lanes without a valid sample have zero normals, so that no light
// reaches them.
struct alignas(64) SampleBlock {
  float position[3][block_lanes];          // x, y, z [scene units]
  float shading_normal[3][block_lanes];    // unit
  float geometric_normal[3][block_lanes];  // unit
};

struct alignas(64) BlockRgb {
  float rgb[3][block_lanes];
};

class SampleBlocks {
 public:
  static constexpr uint32_t no_sample = 0xffffffffu;
  static constexpr uint32_t not_glossy = 0xffffffffu;

  // Lane i of block b holds samples[order[16 b + i]], or nothing where the order says no_sample or ends.
  // eye: where glossy light is seen from.
  SampleBlocks(const std::vector<SurfaceSample>& samples, std::span<const uint32_t> order,
               const glm::vec3& eye);

  size_t count() const { return geometry_.size(); }
  const glm::vec3& eye() const { return eye_; }
  const SampleBlock& geometry(size_t block) const { return geometry_[block]; }
  const BlockBounds& bounds(size_t block) const { return bounds_[block]; }
  const BlockRgb& diffuse(size_t block) const { return diffuse_[block]; }  // Lambert albedo
  // The reflection of the block's 16 samples, or null if none of them has a glossy part.
  const shader::BrdfParams* glossy(size_t block) const {
    return glossy_of_[block] == not_glossy ? nullptr : &glossy_[glossy_of_[block]];
  }
  // Index, in the samples that the blocks were made of, of a lane; no_sample if it holds none.
  uint32_t sample_index(size_t block, size_t lane) const { return order_[block * block_lanes + lane]; }
  int64_t bytes() const;

 private:
  void add(const SurfaceSample& sample, size_t block, size_t lane);
  void add_glossy(const std::vector<SurfaceSample>& samples, size_t block);

  glm::vec3 eye_;
  std::vector<uint32_t> order_;  // 16 a block
  std::vector<SampleBlock> geometry_;
  std::vector<BlockBounds> bounds_;
  std::vector<BlockRgb> diffuse_;
  std::vector<uint32_t> glossy_of_;
  std::vector<shader::BrdfParams> glossy_;  // 16 for each block that is not Lambert throughout
};

// Order 0, 1, 2, ...: neighbours in a gather cloud in tree order are neighbours in space.
std::vector<uint32_t> sequential_order(size_t samples);

// Order of the 2 width x 2 height sub-samples of a view: each block holds the 4x4 sub-samples of 2x2 pixels,
// four consecutive lanes a pixel (upper left, upper right, lower left, lower right; sub-pixels likewise).
// Blocks run row by row; those at the right and lower rim of an odd view are partly empty.
std::vector<uint32_t> pixel_quad_order(int width, int height);

}  // namespace relight
