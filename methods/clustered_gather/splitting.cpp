#include "methods/clustered_gather/splitting.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace relight::clustered_gather {
namespace {

// Members order[first, last) of a cluster.
struct Group {
  size_t first = 0, last = 0;
  Point6 centre;
  double cost = 0.0;  // sum of squared distances to the centre
};

class Splitter {
 public:
  Splitter(std::span<const Point6> points, int iterations)
      : points_(points), order_(points.size()), right_(points.size()), iterations_(iterations) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  Group all() { return describe(0, order_.size()); }

  // Cuts the group in two. `group.cost` must be positive: then two of its points differ.
  std::pair<Group, Group> split(const Group& group) {
    Point6 a = farthest_from(group, group.centre), b = farthest_from(group, a);
    size_t middle = group.first;
    for (int i = 0; i < iterations_; ++i) {
      const size_t before = middle;
      middle = partition(group, a, b);
      // In floats the mean of points that lie close together may be nearer to neither side's points.
      if (middle == group.first || middle == group.last) {
        middle = group.first + (group.last - group.first) / 2;
        break;
      }
      const Point6 a_old = a, b_old = b;
      a = mean(group.first, middle), b = mean(middle, group.last);
      if (middle == before && a.x == a_old.x && b.x == b_old.x) break;
    }
    return {describe(group.first, middle), describe(middle, group.last)};
  }

 private:
  const Point6& point(size_t i) const { return points_[order_[i]]; }

  Point6 mean(size_t first, size_t last) const {
    std::array<double, 8> sum{};
    for (size_t i = first; i < last; ++i)
      for (size_t k = 0; k < 6; ++k) sum[k] += static_cast<double>(point(i).x[k]);
    Point6 m;
    for (size_t k = 0; k < 6; ++k) m.x[k] = static_cast<float>(sum[k] / static_cast<double>(last - first));
    return m;
  }

  Group describe(size_t first, size_t last) const {
    Group group{first, last, mean(first, last), 0.0};
    for (size_t i = first; i < last; ++i)
      group.cost += static_cast<double>(distance2(point(i), group.centre));
    // The mean of equal points is not always one of them; such a group must not look divisible.
    if (std::all_of(order_.begin() + static_cast<std::ptrdiff_t>(first),
                    order_.begin() + static_cast<std::ptrdiff_t>(last),
                    [&](uint32_t i) { return points_[i].x == points_[order_[first]].x; }))
      group.cost = 0.0;
    return group;
  }

  Point6 farthest_from(const Group& group, const Point6& from) const {
    size_t best = group.first;
    float largest = -1.0f;
    for (size_t i = group.first; i < group.last; ++i) {
      const float d = distance2(point(i), from);
      if (d > largest) largest = d, best = i;
    }
    return point(best);
  }

  // Those closer to `a` (or as close) to the front, both sides in their old order. Returns where `b` begins.
  size_t partition(const Group& group, const Point6& a, const Point6& b) {
    size_t front = group.first, back = 0;
    for (size_t i = group.first; i < group.last; ++i) {
      const uint32_t p = order_[i];
      if (distance2(points_[p], a) <= distance2(points_[p], b))
        order_[front++] = p;
      else
        right_[back++] = p;
    }
    std::copy(right_.begin(), right_.begin() + static_cast<std::ptrdiff_t>(back),
              order_.begin() + static_cast<std::ptrdiff_t>(front));
    return front;
  }

  std::span<const Point6> points_;
  std::vector<uint32_t> order_, right_;
  int iterations_;
};

}  // namespace

std::vector<Point6> hierarchical_centres(std::span<const Point6> points, size_t clusters, int iterations) {
  Splitter splitter(points, iterations);
  const auto cheaper = [](const Group& a, const Group& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.first > b.first;
  };
  std::priority_queue<Group, std::vector<Group>, decltype(cheaper)> groups(cheaper);
  groups.push(splitter.all());
  while (groups.size() < clusters && groups.top().cost > 0.0) {
    const Group worst = groups.top();
    groups.pop();
    const auto [a, b] = splitter.split(worst);
    groups.push(a), groups.push(b);
  }
  std::vector<Point6> centres;
  for (; !groups.empty(); groups.pop()) centres.push_back(groups.top().centre);
  return centres;
}

}  // namespace relight::clustered_gather
