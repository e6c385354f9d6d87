// Light of the environment on the samples of a tile (Hasan 2006 section 6: "environment samples"). Element of
// sample i and texel j of the environment square (common/sampling/environment_samples.h):
//
//   F_e,ij = 1/pi  integral over texel j of max(0, cos theta_i) d omega  x V_ij
//
// so that k_d (F_e L) is what the sample reflects of the radiances L of the texels. The integral is linear in
// the normal where the texel is wholly above the sample's horizons (of its shading and its geometric normal),
// and a sum over 4x4 directions where it is not. V_ij is one ray in one of those directions: a random one for
// each texel and tile, the same for all samples of the tile, so that rays form coherent packets of 16
// parallel ones. A sample below whose horizon it points takes another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/sampling/environment_samples.h"
#include "common/sampling/surface_sample.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/lanes.h"

namespace relight::direct_to_indirect {

class EnvironmentGather {
 public:
  // tracer must outlive this.
  EnvironmentGather(const RayTracer& tracer, const EnvironmentSquare& square, uint64_t seed);

  uint32_t texels() const { return static_cast<uint32_t>(texels_.size()); }
  // samples: null where there is none. tile: a number that selects the random directions. Replaces `out` by
  // the elements by texel, ascending; `rays` grows by the rays traced. Thread-safe.
  void elements(const std::array<const SurfaceSample*, lanes>& samples, uint64_t tile,
                std::vector<LaneCoefficient>& out, int64_t& rays) const;

  // Elements of the glossy lobe, for the samples that are glossy: `count` rays that follow the lobe, each of
  // which adds its share to the texel that it leaves the scene in. A lobe may be narrower than a texel: by
  // one value a texel it would be hit or missed.
  void glossy_elements(const std::array<const SurfaceSample*, lanes>& samples, const glm::vec3& eye,
                       int count, uint64_t tile, std::vector<LaneCoefficient>& out, int64_t& rays) const;

 private:
  static constexpr uint32_t directions = 16;  // of a texel
  struct Texel {
    glm::vec3 centre;  // unit
    float reach;       // largest distance of one of its directions from the centre
    glm::vec3 mean;    // of its directions
    std::array<glm::vec3, directions> direction;
  };
  struct Tile;
  uint32_t seen(const Tile& tile, uint32_t texel, uint32_t wholly,
                const std::array<uint32_t, directions>& above, uint32_t lit, int64_t& rays) const;

  const RayTracer& tracer_;
  EnvironmentSquare square_;
  uint64_t seed_;
  float far_;  // beyond everything
  std::vector<Texel> texels_;
};

}  // namespace relight::direct_to_indirect
