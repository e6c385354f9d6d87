// The balanced quad-tree over gather samples.
#include "methods/direct_to_indirect/hierarchy.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

GatherCloud cloud_of(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals) {
  GatherCloud cloud;
  for (size_t i = 0; i < positions.size(); ++i) {
    SurfaceSample s;
    s.position = positions[i], s.geometric_normal = s.shading_normal = normals[i];
    s.valid = true;
    cloud.samples.push_back(s);
    cloud.area.push_back(static_cast<float>(i));
  }
  return cloud;
}

// Red if the reordering drops or repeats a sample, or moves areas apart from their samples.
TEST(Hierarchy, OrderIsAPermutation) {
  std::vector<glm::vec3> p, n;
  for (uint64_t i = 0; i < 256; ++i) {
    p.emplace_back(random_float(1, 0, i, 0), random_float(1, 0, i, 1), random_float(1, 0, i, 2));
    n.emplace_back(0, 1, 0);
  }
  GatherCloud cloud = cloud_of(p, n);
  order_gather_cloud(cloud, 30.0f, 1.7f);
  std::set<float> seen(cloud.area.begin(), cloud.area.end());
  EXPECT_EQ(seen.size(), 256u);
  for (size_t i = 0; i < 256; ++i)
    EXPECT_EQ(cloud.samples[i].position, p[static_cast<size_t>(cloud.area[i])]);
}

// Four well separated groups of 16 must become the root's four children. Red if the split key has the wrong
// sign for one of the centroids, or the halves are not recursed into.
TEST(Hierarchy, SeparatesFourGroupsOfPositions) {
  std::vector<glm::vec3> p, n;
  for (uint64_t i = 0; i < 64; ++i) {
    const auto group = static_cast<float>(i % 4);
    p.emplace_back(100.0f * group + random_float(2, 0, i, 0), random_float(2, 0, i, 1), 0.0f);
    n.emplace_back(0, 1, 0);
  }
  GatherCloud cloud = cloud_of(p, n);
  order_gather_cloud(cloud, 30.0f, 300.0f);
  const GatherHierarchy tree = build_hierarchy(cloud);
  ASSERT_EQ(tree.levels.size(), 4u);
  for (const Cluster& c : tree.levels[1]) EXPECT_LE(c.hi.x - c.lo.x, 1.0f);
}

// At equal positions only normals can tell samples apart. Red if equation 9's second term is missing.
TEST(Hierarchy, SeparatesOpposingNormalsAtEqualPositions) {
  std::vector<glm::vec3> p(16, glm::vec3(1.0f)), n;
  for (int i = 0; i < 16; ++i) n.emplace_back(0, i % 2 == 0 ? 1 : -1, 0);
  GatherCloud cloud = cloud_of(p, n);
  order_gather_cloud(cloud, 30.0f, 1.0f);
  for (size_t i = 1; i < 8; ++i)
    EXPECT_EQ(cloud.samples[i].geometric_normal.y, cloud.samples[0].geometric_normal.y);
  EXPECT_NE(cloud.samples[8].geometric_normal.y, cloud.samples[0].geometric_normal.y);
  // The root's mean normal is zero: no cone may be claimed.
  EXPECT_EQ(build_hierarchy(cloud).levels[0][0].cone_cosine, -1.0f);
}

// All samples equal: every split is a tie. Red if ties are broken by memory order or the iteration never
// ends.
TEST(Hierarchy, BreaksTiesTheSameWayForOneAndTwoThreads) {
  std::vector<std::vector<float>> orders;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    GatherCloud cloud = cloud_of(std::vector<glm::vec3>(4096, glm::vec3(0.5f)),
                                 std::vector<glm::vec3>(4096, glm::vec3(0, 0, 1)));
    order_gather_cloud(cloud, 30.0f, 0.0f);
    orders.push_back(cloud.area);
  }
  EXPECT_EQ(orders[0], orders[1]);
}

TEST(Hierarchy, RefusesACloudThatIsNoPowerOfFour) {
  GatherCloud cloud = cloud_of(std::vector<glm::vec3>(48), std::vector<glm::vec3>(48));
  EXPECT_THROW(order_gather_cloud(cloud, 30.0f, 1.0f), Error);
}

// In the unit cube, facing up.
GatherCloud random_cloud(uint64_t seed) {
  std::vector<glm::vec3> p, n;
  for (uint64_t i = 0; i < 1024; ++i) {
    p.emplace_back(random_float(seed, 0, i, 0), random_float(seed, 0, i, 1), random_float(seed, 0, i, 2));
    n.push_back(
        sample_cosine(glm::vec3(0, 1, 0), {random_float(seed, 0, i, 3), random_float(seed, 0, i, 4)}));
  }
  return cloud_of(p, n);
}

// Red if a cone or box forgets a member: culling would then drop light.
TEST(Hierarchy, BoxesAndConesHoldTheirMembers) {
  GatherCloud cloud = random_cloud(5);
  order_gather_cloud(cloud, 30.0f, 1.7f);
  const GatherHierarchy tree = build_hierarchy(cloud);
  for (const auto& level : tree.levels)
    for (size_t i = 0; i < level.size(); ++i) {
      const size_t size = 1024 / level.size();
      for (size_t s = i * size; s < (i + 1) * size; ++s) {
        EXPECT_GE(glm::dot(cloud.samples[s].geometric_normal, level[i].cone_axis),
                  level[i].cone_cosine - 1e-6f);
        EXPECT_EQ(glm::clamp(cloud.samples[s].position, level[i].lo, level[i].hi), cloud.samples[s].position);
      }
    }
}

// Areas are 0 to 1,023, one of them zero. Red if a mean forgets the weights (tried), or takes its members
// from another cluster (tried: the first four for all).
TEST(Hierarchy, MeansAreWeightedByArea) {
  GatherCloud cloud = random_cloud(6);
  order_gather_cloud(cloud, 30.0f, 1.7f);
  const GatherHierarchy tree = build_hierarchy(cloud);
  ASSERT_EQ(tree.means.size() + 1, tree.levels.size());
  for (const auto& level : tree.means)
    for (size_t i = 0; i < level.size(); ++i) {
      const size_t size = 1024 / level.size();
      double area = 0.0;
      glm::dvec3 position(0.0), normal(0.0);
      for (size_t s = i * size; s < (i + 1) * size; ++s) {
        const auto a = static_cast<double>(cloud.area[s]);
        area += a;
        position += a * glm::dvec3(cloud.samples[s].position);
        normal += a * glm::dvec3(cloud.samples[s].geometric_normal);
      }
      // Five levels, each rounded to float once: 5 x 2^-24 of a coordinate up to one.
      EXPECT_NEAR(static_cast<double>(level[i].area) * static_cast<double>(size), area, 3e-7 * area);
      EXPECT_LT(glm::distance(glm::dvec3(level[i].position), position / area), 6e-7);
      EXPECT_LT(glm::distance(glm::dvec3(level[i].normal), normal / area), 6e-7);
    }
}

// Areas that underflow. Red if they are divided by (tried).
TEST(Hierarchy, MeansOfClustersWithoutAreaAreFinite) {
  GatherCloud cloud =
      cloud_of(std::vector<glm::vec3>(16, glm::vec3(1.0f)), std::vector<glm::vec3>(16, glm::vec3(0, 1, 0)));
  cloud.area.assign(16, 0.0f);
  for (const auto& level : build_hierarchy(cloud).means)
    for (const GatherPoint& mean : level) {
      EXPECT_EQ(mean.position, glm::vec3(1.0f));
      EXPECT_EQ(mean.area, 0.0f);
    }
}

}  // namespace
}  // namespace relight::direct_to_indirect
