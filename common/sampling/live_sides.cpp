#include "common/sampling/live_sides.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

#include "common/sampling/random.h"

namespace relight {
namespace {

constexpr uint64_t stream = 0x11fe51de5ull;
// 262,144 walks of 6 bounces: about 1.5 M hits, so that a side at the density threshold of 1e-3 on 1 % of the
// area still expects more than ten hits; a fraction of a second.
constexpr int64_t walks = 1 << 18;
constexpr int walk_length = 6;

// Union-find over vertices merged by position; returns a component number a triangle.
std::vector<uint32_t> connected_components(const Scene& scene, int64_t& count) {
  const size_t n = scene.positions.size();
  std::vector<uint32_t> order(n), parent(n);
  std::iota(order.begin(), order.end(), 0u);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto less = [&](uint32_t a, uint32_t b) {
    const glm::vec3 &p = scene.positions[a], &q = scene.positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  };
  std::sort(order.begin(), order.end(), less);
  const auto find = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  };
  for (size_t i = 1; i < n; ++i)
    if (scene.positions[order[i]] == scene.positions[order[i - 1]]) join(order[i], order[i - 1]);
  for (const Triangle& t : scene.triangles) join(t.v[0], t.v[1]), join(t.v[0], t.v[2]);

  std::vector<uint32_t> number(n, UINT32_MAX), component(scene.triangles.size());
  uint32_t next = 0;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    uint32_t& k = number[find(scene.triangles[t].v[0])];
    if (k == UINT32_MAX) k = next++;
    component[t] = k;
  }
  count = next;
  return component;
}

// Side index of a sample seen on triangle t: 0 if its geometric normal agrees with the area normal.
int side_of(const Scene& scene, const SurfaceSample& s) {
  return glm::dot(scene.area_normal(s.triangle), s.geometric_normal) >= 0.0f ? 0 : 1;
}

// Sides hit by walk number w, as 2 x triangle + side; UINT32_MAX where the walk has ended.
void walk(const RayTracer& tracer, const DeepFrameBuffer& buffer, uint64_t seed, int64_t w, uint32_t* hits) {
  const auto pick =
      static_cast<size_t>(random_bits(seed, stream, static_cast<uint64_t>(w), 0) % buffer.indirect.size());
  SurfaceSample at = buffer.indirect[pick];
  for (int bounce = 0; bounce < walk_length; ++bounce) {
    hits[bounce] = UINT32_MAX;
    if (!at.valid) continue;
    hits[bounce] = 2 * at.triangle + static_cast<uint32_t>(side_of(tracer.scene(), at));
    const glm::vec2 u(
        random_float(seed, stream, static_cast<uint64_t>(w), static_cast<uint64_t>(2 * bounce + 1)),
        random_float(seed, stream, static_cast<uint64_t>(w), static_cast<uint64_t>(2 * bounce + 2)));
    const glm::vec3 direction = sample_cosine(at.geometric_normal, u);
    const Hit hit = tracer.intersect(tracer.offset_point(at.position, at.geometric_normal), direction);
    at = hit.valid ? tracer.surface(hit, direction) : SurfaceSample{};
  }
}

}  // namespace

LiveSides find_live_sides(const RayTracer& tracer, const DeepFrameBuffer& buffer, uint64_t seed,
                          double density_threshold) {
  const Scene& scene = tracer.scene();
  std::vector<uint32_t> hits(static_cast<size_t>(walks) * walk_length);
  tbb::parallel_for(int64_t{0}, walks,
                    [&](int64_t w) { walk(tracer, buffer, seed, w, hits.data() + w * walk_length); });

  LiveSides live;
  const std::vector<uint32_t> component = connected_components(scene, live.components);
  std::vector<double> area(static_cast<size_t>(live.components)),
      count(2 * static_cast<size_t>(live.components));
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    area[component[t]] += 0.5 * glm::length(glm::dvec3(scene.area_normal(t)));
  double all_hits = 0.0, hit_area = 0.0;
  for (const uint32_t h : hits) {
    if (h == UINT32_MAX) continue;
    count[2 * component[h / 2] + h % 2] += 1.0;
    all_hits += 1.0;
  }
  for (size_t s = 0; s < count.size(); ++s)
    if (count[s] > 0.0) hit_area += area[s / 2];
  if (all_hits == 0.0) return all_sides_live(scene);  // the camera sees nothing: no reason to prefer any side

  double dead_area = 0.0, all_area = 0.0;
  live.sides.assign(scene.triangles.size(), 0);
  std::vector<uint8_t> alive(count.size());
  for (size_t s = 0; s < count.size(); ++s) {
    alive[s] = count[s] * hit_area >= density_threshold * all_hits * area[s / 2] && count[s] > 0.0;
    all_area += area[s / 2];
    if (!alive[s]) dead_area += area[s / 2];
  }
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    live.sides[t] = static_cast<uint8_t>(alive[2 * component[t]] | (alive[2 * component[t] + 1] << 1));
  live.dropped_area_share = all_area > 0.0 ? dead_area / all_area : 0.0;
  return live;
}

LiveSides all_sides_live(const Scene& scene) {
  LiveSides live;
  live.sides.assign(scene.triangles.size(), 3);
  return live;
}

}  // namespace relight
