#include "common/scene/topology.h"

#include <algorithm>
#include <bit>

#include "common/sampling/random.h"

namespace relight {

namespace {

uint64_t hash_position(const glm::vec3& p) {
  // Adding 0 turns -0.0 into 0.0.
  const auto bits = [](float x) { return static_cast<uint64_t>(std::bit_cast<uint32_t>(x + 0.0f)); };
  return hash_combine(bits(p.x) | bits(p.y) << 32, bits(p.z));
}

// An undirected edge as one sortable word, and whether a triangle runs along it from the lower to the higher
// vertex.
struct EdgeUse {
  uint64_t key;
  bool ascending;
};

}  // namespace

std::vector<uint32_t> weld_positions(const std::vector<glm::vec3>& positions) {
  constexpr uint32_t empty = UINT32_MAX;
  const size_t slots = std::bit_ceil(2 * positions.size() + 1);
  std::vector<uint32_t> table(slots, empty), first(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    size_t slot = hash_position(positions[i]) & (slots - 1);
    while (table[slot] != empty && positions[table[slot]] != positions[i]) slot = (slot + 1) & (slots - 1);
    if (table[slot] == empty) table[slot] = static_cast<uint32_t>(i);
    first[i] = table[slot];
  }
  return first;
}

EdgeReport examine_edges(const std::vector<uint32_t>& welded, const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const uint64_t a = welded[t.v[k]], b = welded[t.v[(k + 1) % 3]];
      uses.push_back({std::min(a, b) << 32 | std::max(a, b), a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.key < b.key; });
  EdgeReport report;
  for (size_t i = 0, end = 0; i < uses.size(); i = end) {
    int ascending = 0;
    for (end = i; end < uses.size() && uses[end].key == uses[i].key; ++end) ascending += uses[end].ascending;
    const size_t count = end - i;
    ++report.edges;
    report.boundary += count == 1;
    report.non_manifold += count > 2;
    report.flipped += count == 2 && ascending != 1;
  }
  return report;
}

std::vector<uint32_t> connected_components(const std::vector<uint32_t>& welded,
                                           const std::vector<Triangle>& triangles) {
  // Union-find over welded vertices.
  std::vector<uint32_t> parent = welded;
  const auto find = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  };
  for (const Triangle& t : triangles) join(t.v[0], t.v[1]), join(t.v[0], t.v[2]);

  constexpr uint32_t none = UINT32_MAX;
  std::vector<uint32_t> number(parent.size(), none), component(triangles.size());
  uint32_t next = 0;
  for (size_t t = 0; t < triangles.size(); ++t) {
    uint32_t& k = number[find(triangles[t].v[0])];
    if (k == none) k = next++;
    component[t] = k;
  }
  return component;
}

double signed_volume(const std::vector<glm::vec3>& positions, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return 0.0;
  // About a vertex of the mesh rather than the origin: no cancellation for a small mesh far away.
  const glm::dvec3 origin(positions[triangles[0].v[0]]);
  double six_volumes = 0.0;
  for (const Triangle& t : triangles) {
    const glm::dvec3 a = glm::dvec3(positions[t.v[0]]) - origin, b = glm::dvec3(positions[t.v[1]]) - origin;
    six_volumes += glm::dot(a, glm::cross(b, glm::dvec3(positions[t.v[2]]) - origin));
  }
  return six_volumes / 6.0;
}

}  // namespace relight
