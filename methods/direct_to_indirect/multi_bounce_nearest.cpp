#include "methods/direct_to_indirect/multi_bounce_nearest.h"

#include <algorithm>

#include <nanoflann.hpp>

namespace relight::direct_to_indirect {
namespace {

struct Points {
  const std::vector<Photon>& photons;
  size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(size_t i, size_t dimension) const {
    return photons[i].position[static_cast<glm::length_t>(dimension)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // found by the tree itself
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<float, Points>;
using Index = nanoflann::KDTreeSingleIndexAdaptor<Metric, Points, 3, uint32_t>;

// The library's own result set keeps a sorted list, at a cost of `count` moves a point: too much for
// thousands. This one collects twice as many and then drops the farther half.
class NearestSet {
 public:
  using DistanceType = float;
  NearestSet(size_t count, std::vector<Neighbour>& out) : count_(count), found_(out) {
    found_.clear();
    found_.reserve(2 * count_);
  }
  size_t size() const { return found_.size(); }
  bool full() const { return found_.size() >= count_; }
  float worstDist() const { return worst_; }
  bool addPoint(float distance2, uint32_t photon) {
    if (distance2 < worst_) found_.push_back({distance2, photon});
    if (found_.size() == 2 * count_) prune();
    return true;  // go on searching
  }
  void prune() {
    if (found_.size() <= count_) return;
    const auto last = found_.begin() + static_cast<std::ptrdiff_t>(count_ - 1);
    std::nth_element(found_.begin(), last, found_.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.photon < b.photon;
    });
    found_.resize(count_);
    worst_ = found_.back().distance2;
  }

 private:
  size_t count_;
  std::vector<Neighbour>& found_;
  float worst_ = std::numeric_limits<float>::max();
};

}  // namespace

struct NearestPhotons::Tree {
  Points points;
  Index index;
  explicit Tree(const std::vector<Photon>& photons)
      : points{photons}, index(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(32)) {}
};

NearestPhotons::NearestPhotons(const std::vector<Photon>& photons) : tree_(std::make_unique<Tree>(photons)) {}
NearestPhotons::~NearestPhotons() = default;

void NearestPhotons::find(const glm::vec3& position, size_t count, std::vector<Neighbour>& out) const {
  NearestSet nearest(count, out);
  tree_->index.findNeighbors(nearest, &position.x, nanoflann::SearchParams());
  nearest.prune();
}

}  // namespace relight::direct_to_indirect
