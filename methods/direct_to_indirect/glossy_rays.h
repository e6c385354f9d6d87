// Elements of the glossy final-gather matrix F_g from rays that follow the view sample's lobe, each snapped
// to the gather sample in whose cell it ends. Not in the paper, whose links evaluate the lobe at one point of
// a cell (section 4.3): a lobe narrower than a cell then hits or misses the point. Here an element is the
// share of the lobe that falls into the cell, whatever its width, and there is no 1/r^2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/gather_cells.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/lanes.h"

namespace relight::direct_to_indirect {

class GlossyRays {
 public:
  // rays: of each glossy view sample. tracer and cloud must outlive this.
  GlossyRays(const RayTracer& tracer, const GatherCloud& cloud, int rays, uint64_t seed)
      : tracer_(tracer), cells_(cloud), rays_(rays), seed_(seed) {}

  // Elements of a tile's rows by gather sample, ascending. lobes[i] and samples[i] count where bit i of
  // `mask` is set. `tile` selects the random numbers; rays that were shot are added to `rays`. Thread-safe.
  void elements(const std::array<const SurfaceSample*, lanes>& samples,
                const std::array<GlossyLobe, lanes>& lobes, uint32_t mask, uint64_t tile,
                std::vector<LaneCoefficient>& out, int64_t& rays) const;

 private:
  struct Share {
    uint32_t sample, lane;
    float value;
  };
  void shoot(const SurfaceSample& view, const GlossyLobe& lobe, uint32_t lane, uint64_t number,
             std::vector<Share>& shares, int64_t& rays) const;

  const RayTracer& tracer_;
  GatherCells cells_;
  int rays_;
  uint64_t seed_;
};

}  // namespace relight::direct_to_indirect
