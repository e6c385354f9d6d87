// Which clusters the walk of tile_gather.h enters, and which it takes as a whole: culling by planes and
// normal cones, and the solid-angle heuristic. Each question is first asked of the tile's bounds, which
// decide it for all 16 view samples in most cases, with the answer that each of them would give.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {
namespace {

// Largest value of dot(n, x - p) over a box, by lane; the box is completely behind the plane if it is not
// positive.
struct BoxSupport {
  glm::vec3 lo, hi;
  float operator()(float nx, float ny, float nz, float px, float py, float pz) const {
    return std::max(nx * (lo.x - px), nx * (hi.x - px)) + std::max(ny * (lo.y - py), ny * (hi.y - py)) +
           std::max(nz * (lo.z - pz), nz * (hi.z - pz));
  }
};

}  // namespace

void TileGather::bound_tile(uint32_t mask) {
  glm::vec3 lo(INFINITY), hi(-INFINITY);
  bounds_.flat = true;
  bool first = true;
  for (size_t i = 0; i < lanes; ++i) {
    if (!(mask >> i & 1u)) continue;
    const glm::vec3 p(px_[i], py_[i], pz_[i]), s(sx_[i], sy_[i], sz_[i]), g(gx_[i], gy_[i], gz_[i]);
    lo = glm::min(lo, p), hi = glm::max(hi, p);
    if (first) bounds_.normal = s;
    first = false;
    bounds_.flat = bounds_.flat && s == bounds_.normal && g == bounds_.normal;
  }
  bounds_.centre = 0.5f * (lo + hi);
  const Cluster& all = tree_.levels[0][0];
  const auto largest = [](const glm::vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  };
  bounds_.rounding = 1e-5f * std::max({largest(lo), largest(hi), largest(all.lo), largest(all.hi)});
  bounds_.radius = 0.5f * glm::length(hi - lo) + bounds_.rounding;
  bounds_.lowest = INFINITY, bounds_.highest = -INFINITY;
  for (size_t i = 0; i < lanes; ++i) {
    if (!(mask >> i & 1u)) continue;
    const float height = glm::dot(bounds_.normal, glm::vec3(px_[i], py_[i], pz_[i]));
    bounds_.lowest = std::min(bounds_.lowest, height), bounds_.highest = std::max(bounds_.highest, height);
  }
}

SeenCluster TileGather::seen(const Cluster& cluster) const {
  const glm::vec3 centre = 0.5f * (cluster.lo + cluster.hi), half = 0.5f * (cluster.hi - cluster.lo);
  return {cluster, centre, half, glm::dot(half, half), glm::length(bounds_.centre - centre)};
}

// Lanes for which some of the cluster is above both the shading and the geometric plane of the view sample.
uint32_t TileGather::in_front(const Cluster& cluster, uint32_t mask) const {
  if (bounds_.flat) {
    const glm::vec3 n = bounds_.normal;
    const glm::vec3 top = glm::max(n * cluster.lo, n * cluster.hi);
    const float highest = top.x + top.y + top.z;
    if (highest - bounds_.highest > bounds_.rounding) return mask;
    if (highest - bounds_.lowest < -bounds_.rounding) return 0;
  }
  const BoxSupport support{cluster.lo, cluster.hi};
  std::array<uint32_t, lanes> above;
  for (size_t i = 0; i < lanes; ++i) {
    const float s = support(sx_[i], sy_[i], sz_[i], px_[i], py_[i], pz_[i]);
    const float g = support(gx_[i], gy_[i], gz_[i], px_[i], py_[i], pz_[i]);
    above[i] = (s > 0.0f) & (g > 0.0f) ? 1 : 0;
  }
  return mask & to_mask(above);
}

// Lanes that may see the front of some member. With half-angle a of the cone of normals and angular radius b
// of the cluster, every member faces away if the angle between axis and direction to the view sample is at
// least 90 + a + b, which must be below 180: a + b < 90. Both conditions times the distance d: with
// sin b = radius / d one root a lane is left, and no division.
uint32_t TileGather::not_facing_away(const SeenCluster& seen, uint32_t mask) const {
  const Cluster& cluster = seen.cluster;
  if (!(cluster.cone_cosine > 0.0f)) return mask;
  // In front of the plane through the centre, across the axis: not even a cone of no width faces away.
  const float towards_tile = glm::dot(cluster.cone_axis, bounds_.centre - seen.centre);
  if (towards_tile - bounds_.radius > bounds_.rounding) return mask;
  const glm::vec3 centre = seen.centre;
  const float radius2 = seen.radius2, radius = std::sqrt(radius2), cos_a = cluster.cone_cosine;
  // Rounding of the bound normals may let a member lie a few ulps outside the cone.
  const float sin_a = std::sqrt(std::max(0.0f, 1.0f - cos_a * cos_a)) + 1e-4f;
  std::array<uint32_t, lanes> maybe;
  for (size_t i = 0; i < lanes; ++i) {
    const float wx = px_[i] - centre.x, wy = py_[i] - centre.y, wz = pz_[i] - centre.z;
    const float d2 = wx * wx + wy * wy + wz * wz;
    const float d_cos_b = std::sqrt(std::max(0.0f, d2 - radius2));
    const float d_towards = wx * cluster.cone_axis.x + wy * cluster.cone_axis.y + wz * cluster.cone_axis.z;
    const bool away = (d2 > radius2) & (cos_a * d_cos_b > sin_a * radius) &
                      (d_towards < -(sin_a * d_cos_b + cos_a * radius));
    maybe[i] = away ? 0 : 1;
  }
  return mask & to_mask(maybe);
}

// That every member of the cluster faces every view sample of the tile, for certain. Then the elements of all
// members are products of cosines of one sign, and their mean is that of the mean point. A member below a
// view sample's plane takes a little from the mean where alone it would count as zero: only next to the
// horizon, where cosines are small.
bool TileGather::faces_as_a_whole(const SeenCluster& seen) const {
  const Cluster& cluster = seen.cluster;
  const float cos_a = cluster.cone_cosine;
  if (!(cos_a > 0.0f)) return false;
  // The least of dot(normal, direction to the tile's centre) over the cone of normals, times the distance,
  // must exceed what positions in the cluster and in the tile can change of it.
  const float sin_a = std::sqrt(std::max(0.0f, 1.0f - cos_a * cos_a)) + 1e-4f;
  const float d_cos_t = glm::dot(cluster.cone_axis, bounds_.centre - seen.centre);
  const float d_sin_t = std::sqrt(std::max(0.0f, seen.distance * seen.distance - d_cos_t * d_cos_t));
  return d_cos_t * cos_a - d_sin_t * sin_a > bounds_.radius + std::sqrt(seen.radius2) + bounds_.rounding;
}

// The solid-angle heuristic of section 4.3, for the closest active view sample.
bool TileGather::needs_subdivision(const SeenCluster& seen, uint32_t mask) const {
  const Cluster& cluster = seen.cluster;
  const glm::vec3 centre = seen.centre, diagonal = cluster.hi - cluster.lo;
  // Without a threshold a cluster is never linked as a whole, not even one whose members coincide: their
  // areas may differ.
  if (settings_.link_threshold <= 0.0f) return true;
  const float size2 = glm::dot(diagonal, diagonal), threshold = settings_.link_threshold;
  const uint32_t lobes = mask & linked_lobes_;
  const float nearest = seen.distance - bounds_.radius, farthest = seen.distance + bounds_.radius;
  constexpr float sure = 1.0001f;  // beyond the rounding of a squared distance
  if (size2 > sure * threshold * farthest * farthest) return true;
  if (nearest > bounds_.rounding && sure * size2 < threshold * nearest * nearest)
    return lobes != 0 && lobes_need_subdivision(cluster, lobes);
  std::array<uint32_t, lanes> close;
  for (size_t i = 0; i < lanes; ++i) {
    const float wx = px_[i] - centre.x, wy = py_[i] - centre.y, wz = pz_[i] - centre.z;
    close[i] = size2 > threshold * (wx * wx + wy * wy + wz * wz) ? 1 : 0;
  }
  if (mask & to_mask(close)) return true;
  return lobes != 0 && lobes_need_subdivision(cluster, lobes);
}

// The same with the lobe (section 4.3: "force more subdivision around the peak of the lobe"): a cluster
// counts as if it were as many times larger as pi rho_g cos exceeds the 1 / 1 of a Lambert surface.
bool TileGather::lobes_need_subdivision(const Cluster& cluster, uint32_t mask) const {
  const glm::vec3 centre = 0.5f * (cluster.lo + cluster.hi), half = 0.5f * (cluster.hi - cluster.lo);
  const float radius2 = glm::dot(half, half);
  if (!(radius2 > 0.0f)) return false;
  for (size_t i = 0; i < lanes; ++i) {
    if (!(mask >> i & 1u)) continue;
    const glm::vec3 w = centre - glm::vec3(px_[i], py_[i], pz_[i]);
    const float d2 = glm::dot(w, w);
    if (d2 <= radius2) return true;
    const float sin2_b = radius2 / d2;
    const float lobe =
        lobe_[i].largest_in_cone(w / std::sqrt(d2), std::sqrt(1.0f - sin2_b), std::sqrt(sin2_b));
    if (4.0f * radius2 * std::numbers::pi_v<float> * lobe > settings_.link_threshold * d2) return true;
  }
  return false;
}

}  // namespace relight::direct_to_indirect
