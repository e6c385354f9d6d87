#include "methods/clustered_gather/clustering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

#include "common/sampling/random.h"
#include "methods/clustered_gather/nearest6.h"
#include "methods/clustered_gather/splitting.h"

namespace relight::clustered_gather {
namespace {

constexpr uint64_t stream = 0x6b6d65616e73ull;
// From here on a search tree is faster than looking at every centre.
constexpr size_t many_centres = 1024;

// Different points, chosen by hash: the smallest of a random key win.
std::vector<Point6> random_centres(std::span<const Point6> points, size_t clusters, uint64_t seed) {
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) { return random_bits(seed, stream, i, 0); };
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<Point6> centres;
  for (size_t i = 0; i < std::min(clusters, order.size()); ++i) centres.push_back(points[order[i]]);
  return centres;
}

// Coordinate by coordinate, so that the distances to eight centres are one vector computation.
class CentreTable {
 public:
  explicit CentreTable(const std::vector<Point6>& centres)
      : count_(centres.size()), padded_((count_ + 7) / 8 * 8) {
    for (size_t k = 0; k < 6; ++k) {
      // Padding repeats the last centre: it never wins against it.
      x_[k].resize(padded_);
      for (size_t c = 0; c < padded_; ++c) x_[k][c] = centres[std::min(c, count_ - 1)].x[k];
    }
    distance_.resize(padded_);
  }
  uint32_t nearest(const Point6& p) {
    float* d = distance_.data();
    for (size_t c = 0; c < padded_; ++c) {
      float sum = 0.0f;
      for (size_t k = 0; k < 6; ++k) sum += (p.x[k] - x_[k][c]) * (p.x[k] - x_[k][c]);
      d[c] = sum;
    }
    return static_cast<uint32_t>(std::min_element(d, d + count_) - d);
  }

 private:
  size_t count_, padded_;
  std::array<std::vector<float>, 6> x_;
  std::vector<float> distance_;
};

// Returns whether any assignment changed.
bool assign(std::span<const Point6> points, Clustering& c) {
  const std::vector<uint32_t> before = c.cluster_of;
  c.cluster_of.resize(points.size());
  if (c.centres.size() < many_centres) {
    CentreTable table(c.centres);
    for (size_t i = 0; i < points.size(); ++i) c.cluster_of[i] = table.nearest(points[i]);
  } else {
    const Nearest6 nearest(c.centres);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), 256), [&](const auto& range) {
      std::vector<Neighbour6> found;
      for (size_t i = range.begin(); i < range.end(); ++i) {
        nearest.find(points[i], 1, found);
        c.cluster_of[i] = found[0].index;
      }
    });
  }
  return c.cluster_of != before;
}

std::vector<uint32_t> members(const Clustering& c) {
  std::vector<uint32_t> count(c.centres.size(), 0);
  for (const uint32_t k : c.cluster_of) ++count[k];
  return count;
}

// A cluster without points takes the point that is farthest from its own centre and does not stand alone.
void fill_empty_clusters(std::span<const Point6> points, Clustering& c) {
  std::vector<uint32_t> count = members(c);
  for (uint32_t empty = 0; empty < count.size(); ++empty) {
    if (count[empty] > 0) continue;
    size_t best = points.size();
    float largest = 0.0f;
    for (size_t i = 0; i < points.size(); ++i) {
      const uint32_t k = c.cluster_of[i];
      if (count[k] < 2) continue;
      const float d = distance2(points[i], c.centres[k]);
      if (d > largest) largest = d, best = i;
    }
    if (best == points.size()) return;  // all points lie on centres: what is left is dropped
    --count[c.cluster_of[best]], ++count[empty];
    c.cluster_of[best] = empty;
    c.centres[empty] = points[best];
  }
}

void move_centres(std::span<const Point6> points, Clustering& c) {
  std::vector<std::array<double, 6>> sum(c.centres.size());
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t k = 0; k < 6; ++k) sum[c.cluster_of[i]][k] += static_cast<double>(points[i].x[k]);
  const std::vector<uint32_t> count = members(c);
  for (size_t j = 0; j < c.centres.size(); ++j)
    for (size_t k = 0; k < 6 && count[j] > 0; ++k)
      c.centres[j].x[k] = static_cast<float>(sum[j][k] / count[j]);
}

void drop_empty_clusters(Clustering& c) {
  const std::vector<uint32_t> count = members(c);
  std::vector<uint32_t> number(count.size());
  uint32_t kept = 0;
  for (size_t j = 0; j < count.size(); ++j) {
    number[j] = kept;
    if (count[j] > 0) c.centres[kept++] = c.centres[j];
  }
  c.centres.resize(kept);
  for (uint32_t& k : c.cluster_of) k = number[k];
}

}  // namespace

Clustering cluster_points(std::span<const Point6> points, const ClusteringSettings& settings) {
  Clustering c;
  if (points.empty()) return c;
  if (settings.clusters >= points.size()) {
    c.centres.assign(points.begin(), points.end());
    c.cluster_of.resize(points.size());
    std::iota(c.cluster_of.begin(), c.cluster_of.end(), 0u);
    return c;
  }
  c.centres = settings.start == ClusteringStart::hierarchical
                  ? hierarchical_centres(points, settings.clusters, settings.split_iterations)
                  : random_centres(points, settings.clusters, settings.seed);
  assign(points, c);
  fill_empty_clusters(points, c);
  for (int i = 0; i < settings.iterations; ++i) {
    move_centres(points, c);
    if (!assign(points, c)) break;
    fill_empty_clusters(points, c);
  }
  move_centres(points, c);
  drop_empty_clusters(c);
  return c;
}

double total_distance(std::span<const Point6> points, const Clustering& clustering) {
  double sum = 0.0;
  for (size_t i = 0; i < points.size(); ++i)
    sum += static_cast<double>(distance2(points[i], clustering.centres[clustering.cluster_of[i]]));
  return sum;
}

}  // namespace relight::clustered_gather
