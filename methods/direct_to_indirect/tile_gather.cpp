#include "methods/direct_to_indirect/tile_gather.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "common/sampling/random.h"
#include "common/wavelet/haar.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0xf1a19a74e2ull;

// Largest value of dot(n, x - p) over a box, by lane; the box is completely behind the plane if it is not
// positive.
struct BoxSupport {
  glm::vec3 lo, hi;
  float operator()(float nx, float ny, float nz, float px, float py, float pz) const {
    return std::max(nx * (lo.x - px), nx * (hi.x - px)) + std::max(ny * (lo.y - py), ny * (hi.y - py)) +
           std::max(nz * (lo.z - pz), nz * (hi.z - pz));
  }
};

// The first near element at or after `sample`.
auto find_near(const std::vector<NearElement>& near, size_t sample) {
  return std::lower_bound(near.begin(), near.end(), sample,
                          [](const NearElement& e, size_t j) { return e.sample < j; });
}

uint32_t to_mask(const std::array<uint32_t, lanes>& flags) {
  uint32_t mask = 0;
  for (uint32_t i = 0; i < lanes; ++i) mask |= flags[i] << i;
  return mask;
}

}  // namespace

void TileGather::gather(const std::array<const SurfaceSample*, lanes>& samples, uint64_t tile) {
  tile_ = tile;
  coefficients_.clear();
  uint32_t mask = 0;
  for (size_t i = 0; i < lanes; ++i) {
    near_[i].clear();
    if (!samples[i] || !samples[i]->valid) continue;
    const SurfaceSample& s = *samples[i];
    mask |= 1u << i;
    px_[i] = s.position.x, py_[i] = s.position.y, pz_[i] = s.position.z;
    sx_[i] = s.shading_normal.x, sy_[i] = s.shading_normal.y, sz_[i] = s.shading_normal.z;
    gx_[i] = s.geometric_normal.x, gy_[i] = s.geometric_normal.y, gz_[i] = s.geometric_normal.z;
    ray_start_.set(static_cast<unsigned>(i), tracer_.offset_point(s.position, s.geometric_normal));
    if (!near_field_) continue;
    near_field_->elements(s, tile * lanes + i, near_[i], counts_.near_rays);
    counts_.near_elements += static_cast<int64_t>(near_[i].size());
  }
  if (mask == 0) return;
  coefficients_.push_back({0, visit(0, 0, mask)});
}

// Returns the scaling coefficient of the cluster's part of each row; appends the details below and at it.
Lanes TileGather::visit(size_t level, size_t index, uint32_t mask) {
  if (level + 1 == tree_.levels.size()) return leaf(level, index, mask);
  const Cluster& cluster = tree_.levels[level][index];
  // The cell of a near sample may reach into the view where the sample itself is behind or faces away.
  const uint32_t near = with_near_members(level, index, mask);
  mask = in_front(cluster, mask);
  if (mask) mask = not_facing_away(cluster, mask);
  mask |= near;
  if (mask == 0) return Lanes{};
  if (!near && !needs_subdivision(cluster, mask)) return link(level, index, mask);

  std::array<Lanes, 4> child;
  for (size_t c = 0; c < 4; ++c) child[c] = visit(level + 1, 4 * index + c, mask);
  Lanes scaling;
  std::array<Lanes, 3> details;
  uint32_t any_bits = 0;  // of the details, but for their signs
  for (size_t i = 0; i < lanes; ++i) {
    float d[3];
    scaling[i] = wavelet::haar_step(child[0][i], child[1][i], child[2][i], child[3][i], d);
    for (size_t t = 0; t < 3; ++t) {
      details[t][i] = d[t];
      any_bits |= std::bit_cast<uint32_t>(d[t]) & 0x7fffffffu;
    }
  }
  if (any_bits) {
    const auto nodes = static_cast<uint32_t>(tree_.levels[level].size());
    for (uint32_t t = 0; t < 3; ++t)
      coefficients_.push_back({(t + 1) * nodes + static_cast<uint32_t>(index), details[t]});
  }
  return scaling;
}

// Lanes that have near samples in the cluster.
uint32_t TileGather::with_near_members(size_t level, size_t index, uint32_t mask) const {
  if (!near_field_) return 0;
  const size_t size = cloud_.samples.size() / tree_.levels[level].size();
  std::array<uint32_t, lanes> any{};
  for (size_t i = 0; i < lanes; ++i) {
    if (near_[i].empty()) continue;
    const auto at = find_near(near_[i], index * size);
    any[i] = at != near_[i].end() && at->sample < (index + 1) * size ? 1 : 0;
  }
  return mask & to_mask(any);
}

// A single sample: the near field's element where it is near, elsewhere a link, which tests it exactly.
Lanes TileGather::leaf(size_t level, size_t index, uint32_t mask) {
  const uint32_t near = with_near_members(level, index, mask);
  Lanes value = (mask & ~near) ? link(level, index, mask & ~near) : Lanes{};
  const float factor = column_scale_.empty() ? 1.0f : 1.0f / column_scale_[index];
  for (size_t i = 0; i < lanes; ++i)
    if (near >> i & 1u) value[i] = find_near(near_[i], index)->value * factor;
  return value;
}

// Lanes for which some of the cluster is above both the shading and the geometric plane of the view sample.
uint32_t TileGather::in_front(const Cluster& cluster, uint32_t mask) const {
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
// least 90 + a + b.
uint32_t TileGather::not_facing_away(const Cluster& cluster, uint32_t mask) const {
  if (!(cluster.cone_cosine > 0.0f)) return mask;
  const glm::vec3 centre = 0.5f * (cluster.lo + cluster.hi), half = 0.5f * (cluster.hi - cluster.lo);
  const float radius2 = glm::dot(half, half), cos_a = cluster.cone_cosine;
  // Rounding of the bound normals may let a member lie a few ulps outside the cone.
  const float sin_a = std::sqrt(std::max(0.0f, 1.0f - cos_a * cos_a)) + 1e-4f;
  std::array<uint32_t, lanes> maybe;
  for (size_t i = 0; i < lanes; ++i) {
    const float wx = px_[i] - centre.x, wy = py_[i] - centre.y, wz = pz_[i] - centre.z;
    const float d2 = wx * wx + wy * wy + wz * wz;
    const float sin2_b = radius2 / d2;
    const float sin_b = std::sqrt(sin2_b), cos_b = std::sqrt(std::max(0.0f, 1.0f - sin2_b));
    const float towards =
        (wx * cluster.cone_axis.x + wy * cluster.cone_axis.y + wz * cluster.cone_axis.z) / std::sqrt(d2);
    const bool away =
        (d2 > radius2) & (cos_a * cos_b > sin_a * sin_b) & (towards < -(sin_a * cos_b + cos_a * sin_b));
    maybe[i] = away ? 0 : 1;
  }
  return mask & to_mask(maybe);
}

// The solid-angle heuristic of section 4.3, for the closest active view sample.
bool TileGather::needs_subdivision(const Cluster& cluster, uint32_t mask) const {
  const glm::vec3 centre = 0.5f * (cluster.lo + cluster.hi), diagonal = cluster.hi - cluster.lo;
  // Without a threshold a cluster is never linked as a whole, not even one whose members coincide: their
  // areas may differ.
  if (settings_.link_threshold <= 0.0f) return true;
  const float size2 = glm::dot(diagonal, diagonal), threshold = settings_.link_threshold;
  std::array<uint32_t, lanes> close;
  for (size_t i = 0; i < lanes; ++i) {
    const float wx = px_[i] - centre.x, wy = py_[i] - centre.y, wz = pz_[i] - centre.z;
    close[i] = size2 > threshold * (wx * wx + wy * wy + wz * wz) ? 1 : 0;
  }
  return (mask & to_mask(close)) != 0;
}

size_t TileGather::random_member(size_t level, size_t index, size_t size) const {
  const uint64_t bits =
      random_bits(settings_.seed, stream, tile_, (static_cast<uint64_t>(level) << 32) | index);
  return static_cast<size_t>(bits % size);
}

// Elements of the matrix without visibility, and the lanes where they are positive. One loop without
// branches, so that it becomes vector code; lanes of no view sample may hold anything.
uint32_t TileGather::elements(const GatherPoint& g, Lanes& value) const {
  const float scaled_area = g.area * std::numbers::inv_pi_v<float>;
  const float disc_area = settings_.disc_elements ? scaled_area : 0.0f;
  const float clamp = settings_.disc_elements ? INFINITY : settings_.form_factor_clamp;
  const glm::vec3 q = g.position, nq = g.normal;
  std::array<uint32_t, lanes> positive;
  for (size_t i = 0; i < lanes; ++i) {
    const float wx = q.x - px_[i], wy = q.y - py_[i], wz = q.z - pz_[i];
    const float r2 = wx * wx + wy * wy + wz * wz;
    const float cos_view = sx_[i] * wx + sy_[i] * wy + sz_[i] * wz;  // times r
    const float above = gx_[i] * wx + gy_[i] * wy + gz_[i] * wz;
    const float cos_gather = -(nq.x * wx + nq.y * wy + nq.z * wz);  // times r
    // Dividing twice keeps tiny scenes from underflowing r^4. pi r^2 + A instead of pi r^2 turns a point's
    // form factor into a disc's.
    const float element = (cos_view / r2) * (cos_gather / (r2 + disc_area)) * scaled_area;
    const float bounded = std::min(element, clamp);
    const bool faces =
        (cos_view > 0.0f) & (above > 0.0f) & (cos_gather > 0.0f) & (r2 > 0.0f) & (bounded > 0.0f);
    value[i] = faces ? bounded : 0.0f;
    positive[i] = faces ? 1 : 0;
  }
  return to_mask(positive);
}

// factor x F / w of one gather sample for each lane, 0 where it is not seen.
Lanes TileGather::seen_elements(size_t member, float factor, uint32_t mask) {
  const GatherPoint& g = tree_.points[member];
  Lanes value;
  mask &= elements(g, value);
  counts_.rays += std::popcount(mask);
  const uint32_t visible =
      mask ? tracer_.visible16(ray_start_, tracer_.offset_point(g.position, g.normal), mask) : 0;
  if (!column_scale_.empty()) factor /= column_scale_[member];
  for (size_t i = 0; i < lanes; ++i) value[i] = (visible >> i & 1u) ? value[i] * factor : 0.0f;
  return value;
}

// The scaling coefficient of `size` equal values F is F sqrt(size), and the details inside the cluster are
// zero. F is the element of one random member, which is taken for all of them, or with all_members their
// mean. The scaled element F / w of one member stands for all of them, too.
Lanes TileGather::link(size_t level, size_t index, uint32_t mask) {
  const size_t size = cloud_.samples.size() / tree_.levels[level].size();
  const float root = std::sqrt(static_cast<float>(size));
  if (settings_.all_members && size > 1) {
    counts_.links += std::popcount(mask);
    Lanes sum{};
    for (size_t member = index * size; member < (index + 1) * size; ++member) {
      const Lanes value = seen_elements(member, 1.0f / root, mask);
      for (size_t i = 0; i < lanes; ++i) sum[i] += value[i];
    }
    return sum;
  }
  const int64_t rays = counts_.rays;
  const Lanes value =
      seen_elements(index * size + (size > 1 ? random_member(level, index, size) : 0), root, mask);
  counts_.links += counts_.rays - rays;
  return value;
}

}  // namespace relight::direct_to_indirect
