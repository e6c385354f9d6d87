#include "methods/direct_to_indirect/glossy_rays.h"

#include <algorithm>

#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x91055e4a75ull;

}  // namespace

void GlossyRays::elements(const std::array<const SurfaceSample*, lanes>& samples,
                          const std::array<GlossyLobe, lanes>& lobes, uint32_t mask, uint64_t tile,
                          std::vector<LaneCoefficient>& out, int64_t& rays) const {
  std::vector<Share> shares;
  for (uint32_t i = 0; i < lanes; ++i)
    if (mask >> i & 1u) shoot(*samples[i], lobes[i], i, tile * lanes + i, shares, rays);
  // Stable: the shares of one element are added in the order of its rays.
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.sample < b.sample; });
  out.clear();
  for (const Share& s : shares) {
    if (out.empty() || out.back().index != s.sample) out.push_back({s.sample, Lanes{}});
    out.back().value[s.lane] += s.value;
  }
}

void GlossyRays::shoot(const SurfaceSample& view, const GlossyLobe& lobe, uint32_t lane, uint64_t number,
                       std::vector<Share>& shares, int64_t& rays) const {
  const glm::vec3 origin = tracer_.offset_point(view.position, view.geometric_normal);
  const float share = 1.0f / static_cast<float>(rays_);
  const uint64_t scramble = random_bits(seed_, stream, number, 0);
  for (int k = 0; k < rays_; ++k) {
    const auto n = static_cast<uint64_t>(k);
    const float u_lobe = random_float(seed_, stream, number, n + 1);
    const GlossyLobe::Sample s = lobe.sample(u_lobe, sobol_2d(static_cast<uint32_t>(k), scramble));
    if (!(s.weight > 0.0f) || !(glm::dot(s.wi, view.geometric_normal) > 0.0f)) continue;
    ++rays;
    const Hit hit = tracer_.intersect(origin, s.wi);
    if (!hit.valid) continue;
    const SurfaceSample seen = tracer_.surface(hit, s.wi);
    if (const auto cell = cells_.find(seen.position, seen.geometric_normal))
      shares.push_back({*cell, lane, share * s.weight});
  }
}

}  // namespace relight::direct_to_indirect
