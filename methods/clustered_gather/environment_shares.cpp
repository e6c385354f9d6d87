#include "methods/clustered_gather/environment_shares.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/sampling/environment_samples.h"

namespace relight::clustered_gather {
namespace {

// The misses of a node: a run, since they are sorted by texel.
struct Node {
  int level;
  uint32_t index;
  size_t first, last;
  float importance;  // weight x width; 0: not to be cut
};

glm::vec3 weight_of(std::span<const Miss> misses) {
  glm::dvec3 sum(0.0);
  for (const Miss& m : misses) sum += glm::dvec3(m.weight);
  return glm::vec3(sum);
}

Node make_node(const std::vector<Miss>& misses, int level, uint32_t index, size_t first, size_t last,
               int levels) {
  const glm::vec3 w = weight_of(std::span(misses).subspan(first, last - first));
  return {level, index, first, last, level < levels ? (w.x + w.y + w.z) * std::ldexp(1.0f, -level) : 0.0f};
}

// The quarters of a node that hold any miss.
std::vector<Node> quarters(const std::vector<Miss>& misses, const Node& node, int levels) {
  const int shift = 2 * (levels - node.level - 1);
  std::vector<Node> out;
  for (size_t first = node.first; first < node.last;) {
    const uint32_t index = misses[first].texel >> shift;
    size_t last = first;
    while (last < node.last && misses[last].texel >> shift == index) ++last;
    out.push_back(make_node(misses, node.level + 1, index, first, last, levels));
    first = last;
  }
  return out;
}

}  // namespace

std::vector<SparseEntryRgb> environment_samples(std::vector<Miss>& misses, int levels, size_t limit) {
  std::stable_sort(misses.begin(), misses.end(),
                   [](const Miss& a, const Miss& b) { return a.texel < b.texel; });
  std::vector<Node> nodes;
  if (!misses.empty()) nodes.push_back(make_node(misses, 0, 0, 0, misses.size(), levels));
  for (;;) {
    const auto best = std::max_element(
        nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.importance < b.importance; });
    if (best == nodes.end() || !(best->importance > 0.0f)) break;
    const std::vector<Node> parts = quarters(misses, *best, levels);
    if (limit > 0 && nodes.size() - 1 + parts.size() > limit) {
      best->importance = 0.0f;
      continue;
    }
    *best = parts[0];
    nodes.insert(nodes.end(), parts.begin() + 1, parts.end());
  }
  std::vector<SparseEntryRgb> row;
  for (const Node& n : nodes)
    row.push_back(
        {pyramid_begin(n.level) + n.index, weight_of(std::span(misses).subspan(n.first, n.last - n.first))});
  return row;
}

}  // namespace relight::clustered_gather
