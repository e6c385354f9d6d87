// k-means with both starts, on sets whose best clustering is known, and on those that break naive code.
// Tried, each red: the cheapest cluster split instead of the worst; empty clusters left empty; empty ones
// kept at the end; means with one member too many; ties to the larger index; a search that does not look at
// equal distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <tbb/global_control.h>

#include "common/sampling/random.h"
#include "methods/clustered_gather/clustering.h"
#include "methods/clustered_gather/nearest6.h"

namespace relight::clustered_gather {
namespace {

float random(uint64_t i, uint64_t k) { return random_float(1, 99, i, k); }

std::vector<Point6> random_points(size_t n) {
  std::vector<Point6> points(n);
  for (size_t i = 0; i < n; ++i)
    for (size_t k = 0; k < 6; ++k) points[i].x[k] = random(i, k);
  return points;
}

// `groups` groups of points, ten apart along the first axis, in mixed order.
std::vector<Point6> grouped_points(size_t n, size_t groups) {
  std::vector<Point6> points = random_points(n);
  for (size_t i = 0; i < n; ++i) points[i].x[0] += 10.0f * static_cast<float>(i % groups);
  return points;
}

ClusteringSettings settings(size_t clusters, ClusteringStart start = ClusteringStart::hierarchical) {
  ClusteringSettings s;
  s.clusters = clusters;
  s.start = start;
  return s;
}

void expect_no_empty_cluster(const Clustering& c, size_t points) {
  EXPECT_EQ(c.cluster_of.size(), points);
  EXPECT_EQ(std::set<uint32_t>(c.cluster_of.begin(), c.cluster_of.end()).size(), c.centres.size());
  for (const uint32_t k : c.cluster_of) EXPECT_LT(k, c.centres.size());
}

// Red if a point goes to a farther centre, or the cluster with the least distance is split.
TEST(Clustering, FindsGroupsThatLieApart) {
  const std::vector<Point6> points = grouped_points(700, 7);
  const Clustering c = cluster_points(points, settings(7));
  ASSERT_EQ(c.centres.size(), 7u);
  for (size_t i = 7; i < points.size(); ++i) EXPECT_EQ(c.cluster_of[i], c.cluster_of[i % 7]);
  expect_no_empty_cluster(c, points.size());
}

// The definition of a local minimum: every centre is the mean of its points, every point is nearest to its
// own centre. The double-precision means here leave room for float rounding of the coordinates only.
TEST(Clustering, EndsInALocalMinimum) {
  const std::vector<Point6> points = random_points(600);
  for (const auto start : {ClusteringStart::hierarchical, ClusteringStart::random}) {
    ClusteringSettings s = settings(24, start);
    s.iterations = 200;
    const Clustering c = cluster_points(points, s);
    std::vector<std::array<double, 6>> sum(24);
    std::vector<double> count(24, 0.0);
    for (size_t i = 0; i < points.size(); ++i) {
      count[c.cluster_of[i]] += 1.0;
      for (size_t k = 0; k < 6; ++k) sum[c.cluster_of[i]][k] += static_cast<double>(points[i].x[k]);
      for (const Point6& centre : c.centres)
        EXPECT_GE(distance2(points[i], centre) + 1e-6f, distance2(points[i], c.centres[c.cluster_of[i]]));
    }
    for (size_t j = 0; j < 24; ++j)
      for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(c.centres[j].x[k], sum[j][k] / count[j], 1e-6);
  }
}

// Red if an iteration makes the clusters worse.
TEST(Clustering, IterationsNeverIncreaseTheTotalDistance) {
  const std::vector<Point6> points = random_points(2000);
  for (const auto start : {ClusteringStart::hierarchical, ClusteringStart::random}) {
    double before = 1e30;
    for (int iterations = 0; iterations < 8; ++iterations) {
      ClusteringSettings s = settings(50, start);
      s.iterations = iterations;
      const double now = total_distance(points, cluster_points(points, s));
      EXPECT_LE(now, before * (1.0 + 1e-6));
      before = now;
    }
  }
}

// The paper's reason for two phases. Groups of very different sizes: random starts put most centres into the
// largest. Red if the hierarchy splits anything but the worst cluster.
TEST(Clustering, TwoPhasesFindSmallGroupsThatRandomStartsMiss) {
  std::vector<Point6> points = random_points(4000);
  for (size_t i = 0; i < points.size(); ++i)
    if (i % 100 == 0) points[i].x[1] += 20.0f + 5.0f * static_cast<float>(i % 1000 / 100);
  const double two_phase = total_distance(points, cluster_points(points, settings(40)));
  const double random = total_distance(points, cluster_points(points, settings(40, ClusteringStart::random)));
  EXPECT_LT(two_phase, 0.9 * random);
}

TEST(Clustering, WithAsManyClustersAsPointsOrMoreEachIsItsOwn) {
  const std::vector<Point6> points = random_points(20);
  for (const size_t clusters : {size_t{20}, size_t{1000}}) {
    const Clustering c = cluster_points(points, settings(clusters));
    ASSERT_EQ(c.centres.size(), 20u);
    for (uint32_t i = 0; i < 20; ++i) EXPECT_EQ(c.cluster_of[i], i);
  }
  EXPECT_TRUE(cluster_points({}, settings(5)).centres.empty());
}

// Fewer different points than clusters: no cluster may be empty, and the split must end. Red if a group of
// equal points is split, or an empty cluster is kept or not filled.
TEST(Clustering, DuplicatesShareAClusterAndNoClusterIsEmpty) {
  std::vector<Point6> points;
  for (size_t i = 0; i < 300; ++i) points.push_back(random_points(3)[i % 3]);
  for (const auto start : {ClusteringStart::hierarchical, ClusteringStart::random}) {
    const Clustering c = cluster_points(points, settings(10, start));
    EXPECT_EQ(c.centres.size(), 3u);
    expect_no_empty_cluster(c, points.size());
    EXPECT_NEAR(total_distance(points, c), 0.0, 1e-9);
  }
  // Three random centres of three different points are often less than three different ones.
  for (uint64_t seed = 1; seed < 9; ++seed) {
    ClusteringSettings s = settings(3, ClusteringStart::random);
    s.seed = seed;
    const Clustering c = cluster_points(points, s);
    EXPECT_EQ(c.centres.size(), 3u) << seed;
    EXPECT_NEAR(total_distance(points, c), 0.0, 1e-9) << seed;
  }
  const std::vector<Point6> equal(50, points[0]);
  const Clustering one = cluster_points(equal, settings(7));
  EXPECT_EQ(one.centres.size(), 1u);
  EXPECT_EQ(one.centres[0].x, points[0].x);
}

// Points on a lattice have ties everywhere. Red if a tie is broken by the order of a search or of threads.
TEST(Clustering, TiesAreBrokenTheSameWayForOneAndTwoThreads) {
  std::vector<Point6> points(20000);
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t k = 0; k < 3; ++k) points[i].x[k] = static_cast<float>((i >> (4 * k)) % 16);
  const auto run = [&](size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return cluster_points(points, settings(1500));
  };
  const Clustering one = run(1), two = run(2);
  EXPECT_EQ(one.cluster_of, two.cluster_of);
}

// Against looking at every point. Red if ties go to the larger index, or the tree misses a neighbour.
TEST(Nearest6, FindsWhatBruteForceFinds) {
  std::vector<Point6> points = random_points(500);
  for (size_t i = 0; i < 490; ++i) points[i] = points[490 + (i * 7) % 10];  // fifty times each: ties
  const Nearest6 nearest(points);
  std::vector<Neighbour6> found;
  for (const size_t count : {size_t{1}, size_t{10}, size_t{600}}) {
    for (size_t q = 0; q < 50; ++q) {
      const Point6& from = points[q * 7];
      std::vector<std::pair<float, uint32_t>> all;
      for (uint32_t i = 0; i < points.size(); ++i) all.emplace_back(distance2(points[i], from), i);
      std::sort(all.begin(), all.end());
      nearest.find(from, count, found);
      ASSERT_EQ(found.size(), std::min(count, points.size()));
      for (size_t k = 0; k < found.size(); ++k) ASSERT_EQ(found[k].index, all[k].second) << q << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace relight::clustered_gather
