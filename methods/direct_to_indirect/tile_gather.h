// The hierarchical walk for one tile of up to 16 view samples: links, visibility packets, Haar transform in
// the tree.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/near_field.h"

namespace relight::direct_to_indirect {

constexpr int lanes = 16;
using Lanes = std::array<float, lanes>;  // one value a view sample of the tile

// A wavelet coefficient of all 16 rows.
struct LaneCoefficient {
  uint32_t index;
  Lanes value;
};

struct GatherCounts {
  int64_t rays = 0;   // segments tested
  int64_t links = 0;  // (view sample, cluster) pairs evaluated
  int64_t near_elements = 0, near_rays = 0;
};

class TileGather {
 public:
  TileGather(const RayTracer& tracer, const GatherCloud& cloud, const GatherHierarchy& hierarchy,
             const FinalGatherSettings& settings, std::span<const float> column_scale,
             const NearField* near_field = nullptr)
      : tracer_(tracer),
        cloud_(cloud),
        tree_(hierarchy),
        settings_(settings),
        column_scale_(column_scale),
        near_field_(near_field) {}

  // samples: 16 pointers, null where there is none. tile: a number that selects the random members.
  // Fills coefficients() with every coefficient that is not zero for all lanes, in no particular order.
  void gather(const std::array<const SurfaceSample*, lanes>& samples, uint64_t tile);
  const std::vector<LaneCoefficient>& coefficients() const { return coefficients_; }
  const GatherCounts& counts() const { return counts_; }

 private:
  Lanes visit(size_t level, size_t index, uint32_t mask);
  Lanes link(size_t level, size_t index, uint32_t mask);
  Lanes seen_elements(size_t member, float factor, uint32_t mask);
  uint32_t in_front(const Cluster& cluster, uint32_t mask) const;
  uint32_t not_facing_away(const Cluster& cluster, uint32_t mask) const;
  bool needs_subdivision(const Cluster& cluster, uint32_t mask) const;
  uint32_t with_near_members(size_t level, size_t index, uint32_t mask) const;
  size_t random_member(size_t level, size_t index, size_t size) const;
  uint32_t elements(const GatherPoint& g, Lanes& value) const;
  Lanes leaf(size_t level, size_t index, uint32_t mask);

  const RayTracer& tracer_;
  const GatherCloud& cloud_;
  const GatherHierarchy& tree_;
  const FinalGatherSettings& settings_;
  std::span<const float> column_scale_;  // elements are divided by it; empty: not scaled
  const NearField* near_field_;          // null: links only
  uint64_t tile_ = 0;
  // Structure of arrays, so that loops over lanes vectorise.
  alignas(64) Lanes px_{}, py_{}, pz_{}, sx_{}, sy_{}, sz_{}, gx_{}, gy_{}, gz_{};
  Points16 ray_start_;
  std::array<std::vector<NearElement>, lanes> near_;  // by view sample
  std::vector<LaneCoefficient> coefficients_;
  GatherCounts counts_;
};

}  // namespace relight::direct_to_indirect
