#include "methods/direct_to_indirect/hierarchy.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight::direct_to_indirect {
namespace {

// Iterations of one split until the partition is stable; the paper iterates to convergence, which takes 3
// to 10. The bound only guards against cycles between equally good splits.
constexpr int max_iterations = 50;
constexpr size_t parallel_grain = 1024;

// A sample in the 6-D metric of equation 9, divided by d: (k/d) position, normal.
using Point = std::array<double, 6>;

struct Keyed {
  double key;
  uint32_t sample;
  bool operator<(const Keyed& o) const { return key != o.key ? key < o.key : sample < o.sample; }
};

class Splitter {
 public:
  explicit Splitter(std::vector<Point> points) : points_(std::move(points)) {}

  // Orders `samples` so that each aligned run of 4^k members is a cluster.
  void order(std::span<uint32_t> samples) const {
    if (samples.size() <= 1) return;
    split(samples);
    const auto left = samples.first(samples.size() / 2), right = samples.last(samples.size() / 2);
    if (samples.size() > parallel_grain)
      tbb::parallel_invoke([&] { order(left); }, [&] { order(right); });
    else
      order(left), order(right);
  }

 private:
  Point mean(std::span<const uint32_t> samples) const {
    Point sum{};
    for (const uint32_t s : samples)
      for (size_t d = 0; d < 6; ++d) sum[d] += points_[s][d];
    for (double& x : sum) x /= static_cast<double>(samples.size());
    return sum;
  }

  double distance2(const Point& a, const Point& b) const {
    double sum = 0.0;
    for (size_t d = 0; d < 6; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
    return sum;
  }

  const Point& farthest_from(const Point& p, std::span<const uint32_t> samples) const {
    uint32_t best = samples[0];
    for (const uint32_t s : samples)
      if (distance2(points_[s], p) > distance2(points_[best], p)) best = s;
    return points_[best];
  }

  // Section 4.2: sort by d(s,c1) - d(s,c2), halve, move the centroids, until the halves stay the same. Only
  // the halves matter, so a selection replaces the sort. `samples` ends as the two halves; returns their
  // cost, the sum of squared distances to the half's mean.
  double refine(std::span<uint32_t> samples, Point c1, Point c2) const {
    const size_t half = samples.size() / 2;
    std::vector<Keyed> keyed(samples.size());
    std::vector<uint32_t> previous;
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      for (size_t i = 0; i < samples.size(); ++i)
        keyed[i] = {distance2(points_[samples[i]], c1) - distance2(points_[samples[i]], c2), samples[i]};
      std::nth_element(keyed.begin(), keyed.begin() + static_cast<std::ptrdiff_t>(half), keyed.end());
      for (size_t i = 0; i < samples.size(); ++i) samples[i] = keyed[i].sample;
      std::vector<uint32_t> members(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(half));
      std::sort(members.begin(), members.end());
      if (members == previous) break;
      previous = std::move(members);
      c1 = mean(samples.first(half));
      c2 = mean(samples.last(half));
    }
    return cost(samples.first(half)) + cost(samples.last(half));
  }

  double cost(std::span<const uint32_t> samples) const {
    const Point c = mean(samples);
    double sum = 0.0;
    for (const uint32_t s : samples) sum += distance2(points_[s], c);
    return sum;
  }

  // The paper leaves the start open, and the iteration stops at the nearest local optimum: start from the
  // farthest pair and from each coordinate axis of the 6-D space, and keep the best.
  void split(std::span<uint32_t> samples) const {
    const std::vector<uint32_t> original(samples.begin(), samples.end());
    const Point centre = mean(original), far1 = farthest_from(centre, original),
                far2 = farthest_from(far1, original);
    double best = refine(samples, far1, far2);
    std::vector<uint32_t> attempt;
    for (size_t axis = 0; axis < 6 && samples.size() > 2; ++axis) {
      attempt = original;
      Point a = centre, b = centre;
      a[axis] -= 1.0, b[axis] += 1.0;
      const double c = refine(attempt, a, b);
      if (c < best) best = c, std::copy(attempt.begin(), attempt.end(), samples.begin());
    }
  }

  std::vector<Point> points_;
};

template <typename T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<uint32_t>& order) {
  std::vector<T> out(values.size());
  for (size_t i = 0; i < order.size(); ++i) out[i] = values[order[i]];
  return out;
}

Cluster bound(std::span<const SurfaceSample> members) {
  Cluster c{members[0].position, members[0].position, glm::vec3(0, 0, 1), -1.0f};
  glm::dvec3 sum(0.0);
  for (const SurfaceSample& s : members) {
    c.lo = glm::min(c.lo, s.position), c.hi = glm::max(c.hi, s.position);
    sum += glm::dvec3(s.geometric_normal);
  }
  if (glm::length(sum) < 1e-6 * static_cast<double>(members.size()))
    return c;  // opposing normals: no usable axis
  c.cone_axis = glm::vec3(glm::normalize(sum));
  c.cone_cosine = 1.0f;
  for (const SurfaceSample& s : members)
    c.cone_cosine = std::min(c.cone_cosine, glm::dot(s.geometric_normal, c.cone_axis));
  return c;
}

GatherPoint mean(std::span<const GatherPoint> children) {
  double area = 0.0;
  glm::dvec3 position(0.0), normal(0.0);
  for (const GatherPoint& c : children) {
    const auto weight = static_cast<double>(c.area);
    area += weight;
    position += weight * glm::dvec3(c.position), normal += weight * glm::dvec3(c.normal);
  }
  if (!(area > 0.0)) return {children[0].position, 0.0f, children[0].normal};
  return {glm::vec3(position / area), static_cast<float>(area / static_cast<double>(children.size())),
          glm::vec3(normal / area)};
}

std::vector<std::vector<GatherPoint>> means_of_clusters(const GatherHierarchy& tree) {
  std::vector<std::vector<GatherPoint>> means(tree.levels.size() - 1);
  const std::vector<GatherPoint>* below = &tree.points;
  for (size_t level = means.size(); level-- > 0; below = &means[level]) {
    means[level].resize(below->size() / 4);
    for (size_t i = 0; i < means[level].size(); ++i)
      means[level][i] = mean(std::span(*below).subspan(4 * i, 4));
  }
  return means;
}

}  // namespace

void order_gather_cloud(GatherCloud& cloud, float k, float scene_diagonal) {
  const size_t n = cloud.samples.size();
  if (!wavelet::is_power_of_four(static_cast<int64_t>(n)))
    fail("gather_samples = {}: the hierarchy needs a power of four (4096, 16384, 65536, ...)", n);
  const double scale =
      scene_diagonal > 0.0f ? static_cast<double>(k) / static_cast<double>(scene_diagonal) : 0.0;
  std::vector<Point> points(n);
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 p = glm::dvec3(cloud.samples[i].position) * scale, m(cloud.samples[i].geometric_normal);
    points[i] = {p.x, p.y, p.z, m.x, m.y, m.z};
  }
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  Splitter(std::move(points)).order(order);
  cloud.samples = permuted(cloud.samples, order);
  cloud.area = permuted(cloud.area, order);
}

GatherHierarchy build_hierarchy(const GatherCloud& ordered_cloud) {
  const size_t n = ordered_cloud.samples.size();
  GatherHierarchy tree;
  for (size_t i = 0; i < n; ++i) {
    const SurfaceSample& s = ordered_cloud.samples[i];
    tree.points.push_back({s.position, ordered_cloud.area[i], s.geometric_normal});
  }
  for (size_t nodes = 1; nodes <= n; nodes *= 4) {
    std::vector<Cluster> level(nodes);
    const size_t size = n / nodes;
    tbb::parallel_for(size_t{0}, nodes, [&](size_t i) {
      level[i] = bound(std::span(ordered_cloud.samples).subspan(i * size, size));
    });
    tree.levels.push_back(std::move(level));
  }
  tree.means = means_of_clusters(tree);
  return tree;
}

}  // namespace relight::direct_to_indirect
