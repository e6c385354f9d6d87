#include "methods/direct_to_indirect/near_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/brdf/brdf_lobes.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/gather_cells.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x4ea2f1e1dull;

}  // namespace

float near_distance(float area, float threshold) {
  return std::sqrt(area / (threshold * std::numbers::pi_v<float>));
}

// The cells' partition, and for cell_average points inside each: those of cell j are
// points[first[j] .. first[j + 1]).
struct NearField::Cells {
  GatherCells partition;
  std::vector<SurfaceSample> points;
  std::vector<uint32_t> first;
  explicit Cells(const GatherCloud& cloud) : partition(cloud) {}

  void fill(const GatherCloud& cloud, const std::vector<SurfaceSample>& candidates) {
    std::vector<std::vector<uint32_t>> members(cloud.samples.size());
    for (uint32_t i = 0; i < candidates.size(); ++i)
      if (const auto j = partition.find(candidates[i].position, candidates[i].geometric_normal))
        members[*j].push_back(i);
    first.push_back(0);
    for (size_t j = 0; j < members.size(); ++j) {
      if (members[j].empty()) points.push_back(cloud.samples[j]);
      for (const uint32_t i : members[j]) points.push_back(candidates[i]);
      first.push_back(static_cast<uint32_t>(points.size()));
    }
  }
};

NearField::NearField(const RayTracer& tracer, const GatherCloud& cloud, const GatherHierarchy& hierarchy,
                     const NearFieldSettings& settings, const std::vector<SurfaceSample>& cell_points)
    : tracer_(tracer),
      cloud_(cloud),
      tree_(hierarchy),
      settings_(settings),
      cells_(std::make_unique<Cells>(cloud)) {
  largest_area_.resize(tree_.levels.size());
  largest_area_.back() = cloud.area;
  for (size_t level = tree_.levels.size() - 1; level-- > 0;) {
    const std::vector<float>& children = largest_area_[level + 1];
    largest_area_[level].resize(tree_.levels[level].size());
    for (size_t i = 0; i < largest_area_[level].size(); ++i)
      largest_area_[level][i] = *std::max_element(children.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                                  children.begin() + static_cast<std::ptrdiff_t>(4 * i + 4));
  }
  if (!cell_points.empty()) cells_->fill(cloud, cell_points);
}

NearField::~NearField() = default;

void NearField::elements(const SurfaceSample& view, uint64_t number, std::vector<NearElement>& out,
                         int64_t& rays) const {
  out.clear();
  collect(view, 0, 0, out);
  if (out.empty()) return;
  if (cells_->points.empty())
    shoot(view, number, out, rays);
  else
    average_cells(view, out, rays);
}

// Depth first, so in ascending order.
void NearField::collect(const SurfaceSample& view, size_t level, size_t index,
                        std::vector<NearElement>& out) const {
  const Cluster& cluster = tree_.levels[level][index];
  const glm::vec3 closest = glm::clamp(view.position, cluster.lo, cluster.hi);
  const float reach = near_distance(largest_area_[level][index], settings_.threshold);
  const glm::vec3 apart = closest - view.position;
  if (glm::dot(apart, apart) >= reach * reach) return;
  if (level + 1 == tree_.levels.size()) {
    out.push_back({static_cast<uint32_t>(index), 0.0f});
    return;
  }
  for (size_t c = 0; c < 4; ++c) collect(view, level + 1, 4 * index + c, out);
}

// Rays reach a little beyond the farthest near sample: its cell may extend by its own width.
void NearField::shoot(const SurfaceSample& view, uint64_t number, std::vector<NearElement>& near,
                      int64_t& rays) const {
  float reach = 0.0f;
  for (const NearElement& e : near)
    reach = std::max(reach, glm::distance(cloud_.samples[e.sample].position, view.position) +
                                2.0f * std::sqrt(cloud_.area[e.sample]));
  const glm::vec3 origin = tracer_.offset_point(view.position, view.geometric_normal);
  const float share = 1.0f / static_cast<float>(settings_.rays);
  const uint64_t scramble = random_bits(settings_.seed, stream, number, 0);
  for (int k = 0; k < settings_.rays; ++k) {
    const glm::vec3 direction =
        sample_cosine(view.shading_normal, sobol_2d(static_cast<uint32_t>(k), scramble));
    if (!(glm::dot(direction, view.geometric_normal) > 0.0f)) continue;
    ++rays;
    const Hit hit = tracer_.intersect(origin, direction, reach);
    if (!hit.valid) continue;
    const SurfaceSample behind = tracer_.surface(hit, direction);
    const auto cell = cells_->partition.find(behind.position, behind.geometric_normal);
    if (!cell) continue;
    const auto at = std::lower_bound(near.begin(), near.end(), *cell,
                                     [](const NearElement& e, uint32_t j) { return e.sample < j; });
    if (at != near.end() && at->sample == *cell) at->value += share;
  }
}

void NearField::average_cells(const SurfaceSample& view, std::vector<NearElement>& near,
                              int64_t& rays) const {
  for (NearElement& e : near) {
    const uint32_t first = cells_->first[e.sample], last = cells_->first[e.sample + 1];
    const float area = cloud_.area[e.sample] / static_cast<float>(last - first);
    for (uint32_t i = first; i < last; ++i) {
      const SurfaceSample& g = cells_->points[i];
      const glm::vec3 w = g.position - view.position;
      const float r2 = glm::dot(w, w), above = glm::dot(view.geometric_normal, w);
      const float cosines = glm::dot(view.shading_normal, w) * -glm::dot(g.geometric_normal, w);  // times r^2
      if (!(r2 > 0.0f) || !(above > 0.0f) || !(glm::dot(view.shading_normal, w) > 0.0f) || !(cosines > 0.0f))
        continue;
      ++rays;
      if (!tracer_.visible(view.position, view.geometric_normal, g.position, g.geometric_normal)) continue;
      e.value += cosines / r2 * area / (std::numbers::pi_v<float> * r2 + area);
    }
  }
}

}  // namespace relight::direct_to_indirect
