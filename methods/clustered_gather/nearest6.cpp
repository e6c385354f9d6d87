#include "methods/clustered_gather/nearest6.h"

#include <algorithm>
#include <limits>

#include <nanoflann.hpp>

namespace relight::clustered_gather {
namespace {

struct Points {
  std::span<const Point6> points;
  size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(size_t i, size_t dimension) const { return points[i].x[dimension]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // found by the tree itself
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<float, Points>;
using Index = nanoflann::KDTreeSingleIndexAdaptor<Metric, Points, 6, uint32_t>;

bool nearer(const Neighbour6& a, const Neighbour6& b) {
  return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
}

// Sorted list of the nearest so far. Unlike the library's own it breaks ties by index, so that what is found
// does not depend on the order of the search.
class NearestSet {
 public:
  using DistanceType = float;
  NearestSet(size_t count, std::vector<Neighbour6>& out) : count_(count), found_(out) { found_.clear(); }
  size_t size() const { return found_.size(); }
  bool full() const { return found_.size() == count_; }
  // The search skips what is not nearer than this: an equal distance must still be looked at.
  float worstDist() const {
    return full() ? std::nextafter(found_.back().distance2, std::numeric_limits<float>::max())
                  : std::numeric_limits<float>::max();
  }
  bool addPoint(float distance2, uint32_t index) {
    const Neighbour6 n{distance2, index};
    if (full() && !nearer(n, found_.back())) return true;
    if (full()) found_.pop_back();
    found_.insert(std::upper_bound(found_.begin(), found_.end(), n, nearer), n);
    return true;
  }

 private:
  size_t count_;
  std::vector<Neighbour6>& found_;
};

}  // namespace

struct Nearest6::Tree {
  Points points;
  Index index;
  explicit Tree(std::span<const Point6> p)
      : points{p}, index(6, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
};

Nearest6::Nearest6(std::span<const Point6> points) : tree_(std::make_unique<Tree>(points)) {}
Nearest6::~Nearest6() = default;

void Nearest6::find(const Point6& from, size_t count, std::vector<Neighbour6>& out) const {
  NearestSet nearest(std::min(count, tree_->points.points.size()), out);
  tree_->index.findNeighbors(nearest, from.x.data(), nanoflann::SearchParams());
}

}  // namespace relight::clustered_gather
