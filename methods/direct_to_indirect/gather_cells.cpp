#include "methods/direct_to_indirect/gather_cells.h"

#include <array>
#include <cmath>
#include <vector>

#include <nanoflann.hpp>

namespace relight::direct_to_indirect {
namespace {

// Normals a unit apart are as far as points two cell widths apart: enough to keep the two sides of a slab and
// the walls of a corner apart, little enough to let a curved surface belong to its nearest sample.
constexpr float normal_weight = 2.0f;
constexpr float farthest_in_cells = 4.0f;
constexpr float least_normal_cosine = 0.5f;

using Point = std::array<float, 6>;

Point make_point(const glm::vec3& position, const glm::vec3& normal, float cell_width) {
  const glm::vec3 p = position / cell_width, n = normal * normal_weight;
  return {p.x, p.y, p.z, n.x, n.y, n.z};
}

struct Points {
  std::vector<Point> points;
  size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(size_t i, size_t dimension) const { return points[i][dimension]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // found by the tree itself
  }
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 6, uint32_t>;

}  // namespace

struct GatherCells::Tree {
  float cell_width;
  Points points;
  Index index;
  Tree(std::vector<Point> p, float width)
      : cell_width(width),
        points{std::move(p)},
        index(6, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
};

GatherCells::GatherCells(const GatherCloud& cloud) : cloud_(cloud) {
  double width = 0.0;
  for (const float a : cloud.area)
    width += std::sqrt(static_cast<double>(a)) / static_cast<double>(cloud.area.size());
  const float cell_width = width > 0.0 ? static_cast<float>(width) : 1.0f;
  std::vector<Point> points;
  points.reserve(cloud.samples.size());
  for (const SurfaceSample& s : cloud.samples)
    points.push_back(make_point(s.position, s.geometric_normal, cell_width));
  tree_ = std::make_unique<Tree>(std::move(points), cell_width);
}

GatherCells::~GatherCells() = default;

std::optional<uint32_t> GatherCells::find(const glm::vec3& position, const glm::vec3& normal) const {
  const Point query = make_point(position, normal, tree_->cell_width);
  uint32_t sample = 0;
  float distance2 = 0.0f;
  if (tree_->index.knnSearch(query.data(), 1, &sample, &distance2) == 0) return std::nullopt;
  const SurfaceSample& s = cloud_.samples[sample];
  const glm::vec3 apart = s.position - position;
  if (glm::dot(apart, apart) > farthest_in_cells * farthest_in_cells * cloud_.area[sample])
    return std::nullopt;
  if (glm::dot(s.geometric_normal, normal) < least_normal_cosine) return std::nullopt;
  return sample;
}

}  // namespace relight::direct_to_indirect
