#include "methods/direct_to_indirect/environment_gather.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x656e7673616d70ull, glossy_stream = 0x656e76676c6f73ull;

}  // namespace

// The samples of a tile by coordinate, so that loops over them vectorise.
struct EnvironmentGather::Tile {
  uint64_t number;
  uint32_t valid = 0;
  alignas(64) Lanes sx{}, sy{}, sz{}, gx{}, gy{}, gz{};  // shading and geometric normals
  std::array<glm::vec3, lanes> origin{};

  Tile(const std::array<const SurfaceSample*, lanes>& samples, const RayTracer& tracer, uint64_t which)
      : number(which) {
    for (uint32_t i = 0; i < lanes; ++i) {
      if (!samples[i] || !samples[i]->valid) continue;
      const glm::vec3 s = samples[i]->shading_normal, g = samples[i]->geometric_normal;
      valid |= 1u << i;
      sx[i] = s.x, sy[i] = s.y, sz[i] = s.z, gx[i] = g.x, gy[i] = g.y, gz[i] = g.z;
      origin[i] = tracer.offset_point(samples[i]->position, g);
    }
  }
  // Cosines of a direction with both normals.
  void cosines(const glm::vec3& d, Lanes& shading, Lanes& geometric) const {
    for (size_t i = 0; i < lanes; ++i) {
      shading[i] = sx[i] * d.x + sy[i] * d.y + sz[i] * d.z;
      geometric[i] = gx[i] * d.x + gy[i] * d.y + gz[i] * d.z;
    }
  }
};

EnvironmentGather::EnvironmentGather(const RayTracer& tracer, const EnvironmentSquare& square, uint64_t seed)
    : tracer_(tracer),
      square_(square),
      seed_(seed),
      far_(2.0f * tracer.scene().bounds.diagonal()),
      texels_(square.texels()) {
  for (uint32_t t = 0; t < square.texels(); ++t) {
    Texel& texel = texels_[t];
    glm::dvec3 sum(0.0);
    for (uint32_t k = 0; k < directions; ++k) {
      const glm::dvec3 d = square.direction(t, {(k % 4 + 0.5) / 4.0, (k / 4 + 0.5) / 4.0});
      texel.direction[k] = glm::vec3(d);
      sum += d;
    }
    texel.mean = glm::vec3(sum / static_cast<double>(directions));
    texel.centre = glm::vec3(glm::normalize(sum));
    texel.reach = 0.0f;
    for (const glm::vec3& d : texel.direction)
      texel.reach = std::max(texel.reach, glm::length(d - texel.centre));
  }
}

void EnvironmentGather::elements(const std::array<const SurfaceSample*, lanes>& samples, uint64_t number,
                                 std::vector<LaneCoefficient>& out, int64_t& rays) const {
  out.clear();
  const Tile tile(samples, tracer_, number);
  if (tile.valid == 0) return;
  const float factor = static_cast<float>(square_.solid_angle() / std::numbers::pi);
  for (uint32_t t = 0; t < texels_.size(); ++t) {
    const Texel& texel = texels_[t];
    Lanes shading, geometric, cosine;
    tile.cosines(texel.centre, shading, geometric);
    std::array<uint32_t, lanes> any, all;
    for (size_t i = 0; i < lanes; ++i) {
      const float lower = std::min(shading[i], geometric[i]);
      any[i] = lower > -texel.reach, all[i] = lower > texel.reach;
    }
    uint32_t lit = to_mask(any) & tile.valid;
    if (lit == 0) continue;
    const uint32_t wholly = to_mask(all) & lit;
    tile.cosines(texel.mean, cosine, geometric);
    std::array<uint32_t, directions> above{};
    if (lit != wholly) {
      Lanes partial{};
      for (uint32_t k = 0; k < directions; ++k) {
        tile.cosines(texel.direction[k], shading, geometric);
        for (size_t i = 0; i < lanes; ++i) {
          const bool is_above = shading[i] > 0.0f && geometric[i] > 0.0f;
          any[i] = is_above;
          partial[i] += is_above ? shading[i] * (1.0f / directions) : 0.0f;
        }
        above[k] = to_mask(any);
      }
      for (size_t i = 0; i < lanes; ++i)
        if (!(wholly >> i & 1u)) cosine[i] = partial[i];
      uint32_t some = wholly;
      for (const uint32_t mask : above) some |= mask;
      lit &= some;
      if (lit == 0) continue;
    }
    const uint32_t visible = seen(tile, t, wholly, above, lit, rays);
    if (visible == 0) continue;
    out.push_back({t, Lanes{}});
    for (size_t i = 0; i < lanes; ++i) out.back().value[i] = visible >> i & 1u ? factor * cosine[i] : 0.0f;
  }
}

// Of the lanes `lit`, those whose ray in the texel leaves the scene. above: by direction, the lanes above
// whose horizons it points; for lanes that are not `wholly` above them.
uint32_t EnvironmentGather::seen(const Tile& tile, uint32_t texel, uint32_t wholly,
                                 const std::array<uint32_t, directions>& above, uint32_t lit,
                                 int64_t& rays) const {
  const auto first = static_cast<uint32_t>(random_bits(seed_, stream, tile.number, texel) % directions);
  uint32_t undecided = lit, free = 0;
  for (uint32_t k = 0; k < directions && undecided != 0; ++k) {
    const uint32_t d = (first + 5 * k) % directions;  // each of them once, and not its neighbour next
    const uint32_t active = undecided & (wholly | above[d]);
    if (active == 0) continue;
    free |= tracer_.visible16_along(tile.origin.data(), far_ * texels_[texel].direction[d], active);
    rays += std::popcount(active);
    undecided &= ~active;
  }
  return free;
}

void EnvironmentGather::glossy_elements(const std::array<const SurfaceSample*, lanes>& samples,
                                        const glm::vec3& eye, int count, uint64_t number,
                                        std::vector<LaneCoefficient>& out, int64_t& rays) const {
  struct Share {
    uint32_t texel, lane;
    float value;
  };
  std::vector<Share> shares;
  for (uint32_t lane = 0; lane < lanes; ++lane) {
    if (!samples[lane] || !is_glossy(*samples[lane])) continue;
    const SurfaceSample& s = *samples[lane];
    const GlossyLobe lobe(s, eye);
    const uint64_t pixel = number * lanes + lane, scramble = random_bits(seed_, glossy_stream, pixel, 0);
    for (int k = 0; k < count; ++k) {
      const float u_lobe = random_float(seed_, glossy_stream, pixel, static_cast<uint64_t>(k) + 1);
      const GlossyLobe::Sample ray = lobe.sample(u_lobe, sobol_2d(static_cast<uint32_t>(k), scramble));
      if (!(ray.weight > 0.0f) || !(glm::dot(ray.wi, s.geometric_normal) > 0.0f)) continue;
      ++rays;
      if (tracer_.visible_from_point(s.position, s.geometric_normal, s.position + ray.wi * far_))
        shares.push_back({square_.texel_of(ray.wi), lane, ray.weight / static_cast<float>(count)});
    }
  }
  // Stable: the shares of one element are added in the order of its rays.
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.texel < b.texel; });
  out.clear();
  for (const Share& s : shares) {
    if (out.empty() || out.back().index != s.texel) out.push_back({s.texel, Lanes{}});
    out.back().value[s.lane] += s.value;
  }
}

}  // namespace relight::direct_to_indirect
