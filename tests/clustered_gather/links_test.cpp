// View clusters and the links of pixels to them. Tried, each red: weights that sum to less than one; links
// around edges kept.
#include <gtest/gtest.h>

#include <cmath>

#include "common/tracing/ray_tracer.h"
#include "methods/clustered_gather/view_clusters.h"
#include "tests/support/tiny_scenes.h"

namespace relight::clustered_gather {
namespace {

struct ViewOfRoom {
  Scene scene = tiny::room();
  RayTracer tracer{scene};
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 64, 48});
  Metric6 metric{scene.bounds.diagonal(), 1.0f};

  Links links(const ViewClusters& clusters, int neighbours) const {
    return link_pixels(buffer, pixels_with(buffer, Part::diffuse), Part::diffuse, clusters, metric,
                       neighbours);
  }
  ViewClusters clusters(size_t wanted) const {
    ClusteringSettings settings;
    settings.clusters = wanted;
    return cluster_view(buffer, pixels_with(buffer, Part::diffuse), metric, settings);
  }
};

// Red if weights are not normalised, negative, or a pixel without a sample has links.
TEST(Links, WeightsAreNotNegativeAndSumToOne) {
  const ViewOfRoom room;
  const ViewClusters clusters = room.clusters(300);
  const Links links = room.links(clusters, 10);
  ASSERT_EQ(links.per_pixel, 10u);
  size_t next = 0;
  for (size_t p = 0; p < room.buffer.indirect.size(); ++p) {
    if (!room.buffer.indirect[p].valid) continue;
    ASSERT_EQ(links.pixel[next], p);
    double sum = 0.0;
    for (size_t k = 10 * next; k < 10 * next + 10; ++k) {
      EXPECT_GE(links.weight[k], 0.0f);
      EXPECT_LT(links.cluster[k], clusters.samples.size());
      sum += static_cast<double>(links.weight[k]);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    ++next;
  }
  EXPECT_EQ(links.pixel.size(), next);
  EXPECT_LT(next, room.buffer.indirect.size());  // there is background
}

// Red if the normals are left out of the choice: floor pixels near the walls would take from the walls.
TEST(Links, DoNotLeakAroundEdges) {
  const ViewOfRoom room;
  const ViewClusters clusters = room.clusters(30);
  const Links links = room.links(clusters, 10);
  for (size_t i = 0; i < links.pixel.size(); ++i)
    for (size_t k = 10 * i; k < 10 * i + 10; ++k) {
      if (links.weight[k] == 0.0f) continue;
      EXPECT_GT(glm::dot(room.buffer.indirect[links.pixel[i]].shading_normal,
                         clusters.samples[links.cluster[k]].shading_normal),
                0.7f);
    }
}

// One cluster a pixel and one neighbour: interpolation is the identity.
TEST(Links, WithEveryPixelItsOwnClusterAPixelTakesItself) {
  const ViewOfRoom room;
  const ViewClusters clusters = room.clusters(0);
  const Links links = room.links(clusters, 1);
  uint32_t next = 0;
  for (const uint32_t p : links.pixel) {
    EXPECT_EQ(links.cluster[next], next);
    EXPECT_EQ(links.weight[next], 1.0f);
    EXPECT_EQ(clusters.samples[next++].position, room.buffer.indirect[p].position);
  }
  EXPECT_EQ(next, clusters.samples.size());
}

// The representative stands on a surface, so that its visibility is that of a surface. Red if it is the mean.
TEST(ViewClusters, StandOnMembersAndFaceTheirMean) {
  const ViewOfRoom room;
  for (const SurfaceSample& s : room.clusters(50).samples) {
    bool found = false;
    for (const SurfaceSample& p : room.buffer.indirect)
      found = found || (p.valid && p.position == s.position && p.geometric_normal == s.geometric_normal);
    EXPECT_TRUE(found);
    EXPECT_NEAR(glm::length(s.shading_normal), 1.0f, 1e-5f);
    EXPECT_GT(glm::dot(s.shading_normal, s.geometric_normal), 0.0f);
  }
}

TEST(ViewClusters, OfAViewOfNothingAreNone) {
  ViewOfRoom room;
  for (SurfaceSample& s : room.buffer.indirect) s.valid = false;
  const ViewClusters clusters = room.clusters(50);
  EXPECT_TRUE(clusters.samples.empty());
  EXPECT_EQ(room.links(clusters, 10).per_pixel, 0u);
}

}  // namespace
}  // namespace relight::clustered_gather
