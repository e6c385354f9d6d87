#include "methods/clustered_gather/representative.h"

#include <cmath>

#include <glm/glm.hpp>

namespace relight::clustered_gather {

SurfaceSample representative(std::span<const SurfaceSample> samples, std::span<const uint32_t> members) {
  if (members.size() == 1) return samples[members[0]];
  glm::dvec3 position(0.0), normal(0.0);
  for (const uint32_t i : members) {
    position += glm::dvec3(samples[i].position);
    normal += glm::dvec3(samples[i].shading_normal);
  }
  position /= static_cast<double>(members.size());
  uint32_t closest = members[0];
  double least = INFINITY;
  for (const uint32_t i : members) {
    const glm::dvec3 d = glm::dvec3(samples[i].position) - position;
    const double d2 = glm::dot(d, d);
    if (d2 < least) least = d2, closest = i;
  }
  SurfaceSample out = samples[closest];
  // Below a hundredth of the sum of lengths the direction of the mean is chance.
  const double length = glm::length(normal);
  if (length < 0.01 * static_cast<double>(members.size())) return out;
  const glm::vec3 mean(normal / length);
  if (glm::dot(mean, out.geometric_normal) > 0.0f) out.shading_normal = mean;
  return out;
}

Members members_of(std::span<const uint32_t> cluster_of, size_t clusters) {
  Members m;
  m.start.assign(clusters + 1, 0);
  for (const uint32_t k : cluster_of) ++m.start[k + 1];
  for (size_t k = 0; k < clusters; ++k) m.start[k + 1] += m.start[k];
  std::vector<uint32_t> next(m.start.begin(), m.start.end() - 1);
  m.list.resize(cluster_of.size());
  for (uint32_t i = 0; i < cluster_of.size(); ++i) m.list[next[cluster_of[i]]++] = i;
  return m;
}

}  // namespace relight::clustered_gather
