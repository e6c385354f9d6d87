// The hierarchical walk for one tile of up to 16 view samples: links, visibility packets, Haar transform in
// the tree. Where view samples are glossy, each link gives an element of both matrices F_d and F_g for one
// visibility ray, and clusters towards which a lobe is large are subdivided further (section 4.3).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/gather_cloud.h"
#include "common/sampling/random.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/lanes.h"
#include "methods/direct_to_indirect/near_field.h"

namespace relight::direct_to_indirect {

struct GatherCounts {
  int64_t rays = 0;   // segments tested
  int64_t links = 0;  // (view sample, cluster) pairs with a positive element
  int64_t near_elements = 0, near_rays = 0;
  int64_t glossy_rays = 0;  // of GlossyRays

  GatherCounts& operator+=(const GatherCounts& other) {
    rays += other.rays, links += other.links;
    near_elements += other.near_elements, near_rays += other.near_rays;
    glossy_rays += other.glossy_rays;
    return *this;
  }
};

// Values of the diffuse matrix, and of both. A walk of a tile without lobes carries the first kind. Zero as
// DiffuseLanes{}; without braces anything, because the walk makes four at each node, and fills them.
struct DiffuseLanes {
  static constexpr bool lobes = false;
  Lanes diffuse;
};
struct LanePair {
  static constexpr bool lobes = true;
  Lanes diffuse, glossy;
};

// Of a tile's view samples: what decides many questions for all of them at once.
struct TileBounds {
  glm::vec3 centre{0.0f};
  float radius = 0.0f;  // of a sphere around the positions
  bool flat = false;    // all normals, shading and geometric, are `normal`
  glm::vec3 normal{0.0f};
  float lowest = 0.0f, highest = 0.0f;  // of dot(normal, position)
  float rounding = 0.0f;                // what float sums of products of coordinates are wrong by, generously
};

// A cluster as the tile sees it.
struct SeenCluster {
  const Cluster& cluster;
  glm::vec3 centre, half;  // of its box
  float radius2;           // squared, of the sphere around the box
  float distance;          // from the tile's centre to its
};

class TileGather {
 public:
  TileGather(const RayTracer& tracer, const GatherCloud& cloud, const GatherHierarchy& hierarchy,
             const FinalGatherSettings& settings, std::span<const float> column_scale,
             const NearField* near_field = nullptr, const GlossyGather* glossy = nullptr)
      : tracer_(tracer),
        cloud_(cloud),
        tree_(hierarchy),
        settings_(settings),
        column_scale_(column_scale),
        near_field_(near_field),
        glossy_(glossy) {}

  // samples: 16 pointers, null where there is none. tile: a number that selects the random members.
  // Fills coefficients() and, for the lanes that are glossy, glossy_coefficients() with every coefficient
  // that is not zero for all lanes, in no particular order.
  void gather(const std::array<const SurfaceSample*, lanes>& samples, uint64_t tile);
  const std::vector<LaneCoefficient>& coefficients() const { return coefficients_; }
  const std::vector<LaneCoefficient>& glossy_coefficients() const { return glossy_coefficients_; }
  const GatherCounts& counts() const { return counts_; }

 private:
  void start_glossy(const std::array<const SurfaceSample*, lanes>& samples, uint32_t mask);
  template <typename Value>
  Value visit(size_t level, size_t index, uint32_t mask);
  template <typename Value>
  Value link(size_t level, size_t index, uint32_t mask, bool by_mean);
  template <typename Value>
  Value seen_elements(const GatherPoint& point, size_t member, float factor, uint32_t mask);
  Lanes glossy_elements(const glm::vec3& member, const Lanes& bounded, uint32_t mask) const;
  // Gather samples of a cluster: each level has four times the clusters of the one above.
  size_t cluster_size(size_t level) const { return cloud_.samples.size() >> (2 * level); }
  void prefetch_children(size_t level, size_t index) const;
  void bound_tile(uint32_t mask);
  SeenCluster seen(const Cluster& cluster) const;
  uint32_t in_front(const Cluster& cluster, uint32_t mask) const;
  uint32_t not_facing_away(const SeenCluster& seen, uint32_t mask) const;
  bool faces_as_a_whole(const SeenCluster& seen) const;
  bool needs_subdivision(const SeenCluster& seen, uint32_t mask) const;
  bool lobes_need_subdivision(const Cluster& cluster, uint32_t mask) const;
  uint32_t with_near_members(size_t level, size_t index, uint32_t mask) const;
  template <typename Value>
  Value leaf(size_t level, size_t index, uint32_t mask);
  // Members that a link to a cluster of `size` takes.
  size_t link_members(size_t size) const {
    return settings_.link_members > 0 ? std::min(size, static_cast<size_t>(settings_.link_members)) : size;
  }
  // The k-th of `members`: one at random of each of as many equal runs of the cluster. Sizes are powers of
  // two, so that masking is the remainder.
  size_t link_member(size_t level, size_t index, size_t size, size_t members, size_t k) const {
    const size_t run = members == 1 ? size : size / members, first = index * size + k * run;
    const uint64_t number = (static_cast<uint64_t>(k) << 40) | (static_cast<uint64_t>(level) << 32) | index;
    return run == 1 ? first : first + (static_cast<size_t>(random_.bits(number)) & (run - 1));
  }
  uint32_t elements(const GatherPoint& g, Lanes& value) const;

  const RayTracer& tracer_;
  const GatherCloud& cloud_;
  const GatherHierarchy& tree_;
  const FinalGatherSettings& settings_;
  std::span<const float> column_scale_;  // elements are divided by it; empty: not scaled
  const NearField* near_field_;          // null: links only
  const GlossyGather* glossy_;           // null: no glossy matrix
  uint64_t tile_ = 0;
  RandomDimensions random_{0, 0, 0};  // of the tile
  // Structure of arrays, so that loops over lanes vectorise.
  alignas(64) Lanes px_{}, py_{}, pz_{}, sx_{}, sy_{}, sz_{}, gx_{}, gy_{}, gz_{};
  TileBounds bounds_;
  SegmentFan ray_start_;
  std::array<std::vector<NearElement>, lanes> near_;  // by view sample
  uint32_t linked_lobes_ = 0;                         // lanes whose links carry glossy elements
  std::array<GlossyLobe, lanes> lobe_;
  std::vector<LaneCoefficient> coefficients_, glossy_coefficients_, elements_;
  GatherCounts counts_;
};

}  // namespace relight::direct_to_indirect
