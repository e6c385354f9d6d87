#include "methods/direct_to_indirect/tile_gather.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "common/sampling/random.h"
#include "methods/direct_to_indirect/glossy_rays.h"
#include "methods/direct_to_indirect/lane_haar.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0xf1a19a74e2ull;

// The first near element at or after `sample`.
auto find_near(const std::vector<NearElement>& near, size_t sample) {
  return std::lower_bound(near.begin(), near.end(), sample,
                          [](const NearElement& e, size_t j) { return e.sample < j; });
}

}  // namespace

void TileGather::gather(const std::array<const SurfaceSample*, lanes>& samples, uint64_t tile) {
  tile_ = tile;
  random_ = RandomDimensions(settings_.seed, stream, tile);
  coefficients_.clear();
  glossy_coefficients_.clear();
  linked_lobes_ = 0;
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
  bound_tile(mask);
  if (glossy_) start_glossy(samples, mask);
  if (linked_lobes_) {
    const auto scaling = visit<LanePair>(0, 0, mask);
    coefficients_.push_back({0, scaling.diffuse});
    glossy_coefficients_.push_back({0, scaling.glossy});
  } else {
    coefficients_.push_back({0, visit<DiffuseLanes>(0, 0, mask).diffuse});
  }
}

// The tile's lobes: rays at once, links along the walk.
void TileGather::start_glossy(const std::array<const SurfaceSample*, lanes>& samples, uint32_t mask) {
  uint32_t lobes = 0;
  for (uint32_t i = 0; i < lanes; ++i) {
    if (!(mask >> i & 1u) || !is_glossy(*samples[i])) continue;
    lobes |= 1u << i;
    lobe_[i] = GlossyLobe(*samples[i], glossy_->eye);
  }
  if (!glossy_->rays) {
    linked_lobes_ = lobes;
    return;
  }
  if (lobes == 0) return;
  glossy_->rays->elements(samples, lobe_, lobes, tile_, elements_, counts_.glossy_rays);
  if (!column_scale_.empty())
    for (LaneCoefficient& e : elements_)
      for (float& v : e.value) v /= column_scale_[e.index];
  forward_lanes(elements_, static_cast<uint32_t>(cloud_.samples.size()), glossy_coefficients_);
}

// Returns the scaling coefficient of the cluster's part of each row; appends the details below and at it.
template <typename Value>
Value TileGather::visit(size_t level, size_t index, uint32_t mask) {
  if (level + 1 == tree_.levels.size()) return leaf<Value>(level, index, mask);
  const Cluster& cluster = tree_.levels[level][index];
  // The cell of a near sample may reach into the view where the sample itself is behind or faces away.
  const uint32_t near = with_near_members(level, index, mask);
  mask = in_front(cluster, mask);
  if ((mask | near) == 0) return {};
  const SeenCluster view = seen(cluster);
  if (mask) mask = not_facing_away(view, mask);
  mask |= near;
  if (mask == 0) return {};
  if (!near && !needs_subdivision(view, mask)) {
    const bool by_mean = settings_.mean_elements && faces_as_a_whole(view);
    return link<Value>(level, index, mask, by_mean);
  }

  prefetch_children(level, index);
  std::array<Value, 4> child;
  for (size_t c = 0; c < 4; ++c) child[c] = visit<Value>(level + 1, 4 * index + c, mask);
  const auto node = static_cast<uint32_t>(index), nodes = uint32_t{1} << (2 * level);
  Value scaling;
  if constexpr (Value::lobes) scaling.glossy = {};
  scaling.diffuse =
      analyse_lanes({&child[0].diffuse, &child[1].diffuse, &child[2].diffuse, &child[3].diffuse}, node, nodes,
                    coefficients_);
  if constexpr (Value::lobes) {
    if (linked_lobes_ & mask)
      scaling.glossy = analyse_lanes({&child[0].glossy, &child[1].glossy, &child[2].glossy, &child[3].glossy},
                                     node, nodes, glossy_coefficients_);
  }
  return scaling;
}

// What the children are asked for first: their boxes, and the member that a link would take. Which member
// that is is random, so that without this every link waits for memory, a tenth of all time. It is wasted
// where a child is culled or entered; the rays of its siblings are far longer than the wait.
void TileGather::prefetch_children(size_t level, size_t index) const {
  const size_t below = level + 1, first = 4 * index;
  const size_t size = cluster_size(below), members = link_members(size);
  const char* clusters = reinterpret_cast<const char*>(&tree_.levels[below][first]);
  for (size_t byte = 0; byte < 4 * sizeof(Cluster); byte += 64) __builtin_prefetch(clusters + byte);
  for (size_t c = 0; c < 4; ++c) {
    for (size_t k = 0; k < std::min(members, size_t{4}); ++k)
      __builtin_prefetch(&tree_.points[link_member(below, first + c, size, members, k)]);
  }
  if (!settings_.mean_elements || below == tree_.means.size()) return;
  const char* means = reinterpret_cast<const char*>(&tree_.means[below][first]);
  for (size_t byte = 0; byte < 4 * sizeof(GatherPoint); byte += 64) __builtin_prefetch(means + byte);
}

// Lanes that have near samples in the cluster.
uint32_t TileGather::with_near_members(size_t level, size_t index, uint32_t mask) const {
  if (!near_field_) return 0;
  const size_t size = cluster_size(level);
  std::array<uint32_t, lanes> any{};
  for (size_t i = 0; i < lanes; ++i) {
    if (near_[i].empty()) continue;
    const auto at = find_near(near_[i], index * size);
    any[i] = at != near_[i].end() && at->sample < (index + 1) * size ? 1 : 0;
  }
  return mask & to_mask(any);
}

// A single sample: the near field's element where it is near, elsewhere a link, which tests it exactly. Lobes
// are linked either way.
template <typename Value>
Value TileGather::leaf(size_t level, size_t index, uint32_t mask) {
  const uint32_t near = with_near_members(level, index, mask);
  const uint32_t linked = mask & (~near | linked_lobes_);
  Value value = linked ? link<Value>(level, index, linked, false) : Value{};
  const float factor = column_scale_.empty() ? 1.0f : 1.0f / column_scale_[index];
  for (size_t i = 0; i < lanes; ++i)
    if (near >> i & 1u) value.diffuse[i] = find_near(near_[i], index)->value * factor;
  return value;
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

// F_g = pi rho_g F_d of unoccluded links to a point, F_d bounded as the diffuse element is. No element
// exceeds what the whole lobe reflects: it may be narrower than the cell that the point stands for.
Lanes TileGather::glossy_elements(const glm::vec3& member, const Lanes& bounded, uint32_t mask) const {
  Lanes value{};
  for (size_t i = 0; i < lanes; ++i) {
    if (!(mask >> i & 1u)) continue;
    const glm::vec3 wi = glm::normalize(member - glm::vec3(px_[i], py_[i], pz_[i]));
    const float element = std::numbers::pi_v<float> * lobe_[i].value(wi) * bounded[i];
    value[i] = element > 0.0f ? std::min(lobe_[i].albedo(), element) : 0.0f;
  }
  return value;
}

// factor x F / w of a point for each lane, 0 where `member`, the point or one that it is the mean of, is not
// seen.
template <typename Value>
Value TileGather::seen_elements(const GatherPoint& point, size_t member, float factor, uint32_t mask) {
  const GatherPoint& g = tree_.points[member];
  Value value;
  if constexpr (Value::lobes) value.glossy = {};
  mask &= elements(point, value.diffuse);
  if constexpr (Value::lobes)
    if (linked_lobes_ & mask)
      value.glossy = glossy_elements(point.position, value.diffuse, linked_lobes_ & mask);
  counts_.rays += std::popcount(mask);
  const uint32_t visible =
      mask ? tracer_.visible16(ray_start_, tracer_.offset_point(g.position, g.normal), mask) : 0;
  if (!column_scale_.empty()) factor /= column_scale_[member];
  for (size_t i = 0; i < lanes; ++i) {
    const bool seen = visible >> i & 1u;
    value.diffuse[i] = seen ? value.diffuse[i] * factor : 0.0f;
    if constexpr (Value::lobes) value.glossy[i] = seen ? value.glossy[i] * factor : 0.0f;
  }
  return value;
}

// The scaling coefficient of `size` equal values F is F sqrt(size), and the details inside the cluster are
// zero. F is the mean over the link's members, of their elements with visibility, or by_mean: of their
// visibility times the mean of all elements without. The scaled element F / w of a member stands for all of
// them, too.
template <typename Value>
Value TileGather::link(size_t level, size_t index, uint32_t mask, bool by_mean) {
  const size_t size = cluster_size(level), members = link_members(size);
  const float factor = std::sqrt(static_cast<float>(size)) / static_cast<float>(members);
  const int64_t rays = counts_.rays;
  Value sum;
  for (size_t k = 0; k < members; ++k) {
    const size_t member = link_member(level, index, size, members, k);
    const GatherPoint& point = by_mean ? tree_.means[level][index] : tree_.points[member];
    const auto value = seen_elements<Value>(point, member, factor, mask);
    if (k == 0) {
      sum = value;
      counts_.links += counts_.rays - rays;
      continue;
    }
    for (size_t i = 0; i < lanes; ++i) {
      sum.diffuse[i] += value.diffuse[i];
      if constexpr (Value::lobes) sum.glossy[i] += value.glossy[i];
    }
  }
  return sum;
}

}  // namespace relight::direct_to_indirect
