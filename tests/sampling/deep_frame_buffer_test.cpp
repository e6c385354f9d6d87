#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "common/run/error.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

// Point where the ray through pixel coordinates (px, py) meets the plane z = 0, in double.
glm::dvec3 on_plane(const Camera& camera, double px, double py, int width, int height) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target - camera.eye));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double half = std::tan(glm::radians(static_cast<double>(camera.fov_y_degrees)) / 2);
  const glm::dvec3 d =
      forward + right * ((2 * px / width - 1) * half * width / height) + up * ((1 - 2 * py / height) * half);
  const glm::dvec3 eye(camera.eye);
  return eye - d * (eye.z / d.z);
}

Scene plane_scene() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  scene.camera = {{1, -2, 4}, {0.5f, 1, 0}, {0, 0, 1}, 50.0f};
  finish_scene(scene);
  return scene;
}

// Red if (each tried): pixel centres, the order of sub-pixels, the aspect ratio or the row order are off.
TEST(DeepFrameBuffer, SamplesLieWhereAnalyticRaysMeetAPlane) {
  const Scene scene = plane_scene();
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 16, 9});
  ASSERT_EQ(buffer.indirect.size(), 16u * 9u);
  ASSERT_EQ(buffer.direct.size(), 32u * 18u);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x) {
      const SurfaceSample& s = buffer.indirect[static_cast<size_t>(y * 16 + x)];
      ASSERT_TRUE(s.valid);
      const glm::dvec3 p = on_plane(scene.camera, x + 0.5, y + 0.5, 16, 9);
      EXPECT_LT(glm::length(glm::dvec3(s.position) - p), 1e-4) << x << ' ' << y;
      EXPECT_NEAR(s.depth, glm::length(p - glm::dvec3(scene.camera.eye)), 1e-4);
      for (int sub = 0; sub < 4; ++sub) {
        const double dx = sub % 2 ? 0.75 : 0.25, dy = sub / 2 ? 0.75 : 0.25;
        const SurfaceSample& d = buffer.direct[static_cast<size_t>((2 * y + sub / 2) * 32 + 2 * x + sub % 2)];
        EXPECT_LT(glm::length(glm::dvec3(d.position) - on_plane(scene.camera, x + dx, y + dy, 16, 9)), 1e-4);
      }
    }
}

// Red if (both tried): normals point inwards, or misses are marked valid.
TEST(DeepFrameBuffer, SamplesLieOnASphereWithItsNormals) {
  Scene scene = tiny::empty_scene();
  tiny::add_sphere(scene, glm::vec3(0.0f), 1.0f, 200);
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 40, 30});
  int hits = 0;
  for (const SurfaceSample& s : buffer.indirect) {
    if (!s.valid) continue;
    ++hits;
    EXPECT_NEAR(glm::length(s.position), 1.0f, 2e-4f);
    EXPECT_GT(glm::dot(s.shading_normal, glm::normalize(s.position)), 0.9999f);
  }
  // The silhouette is a circle: sin(angle) = 1/4.
  const double radius = 15.0 * std::tan(std::asin(0.25)) / std::tan(glm::radians(20.0));
  EXPECT_NEAR(hits, 3.14159265 * radius * radius, 2.0 * radius);
  EXPECT_FALSE(buffer.indirect[0].valid);
}

// Red if (tried): depth differences instead of tangent-plane distances are compared: a grazing floor would be
// all edges.
TEST(EdgeMask, AFlatFloorAtAGrazingAngleHasNoEdges) {
  Scene scene = plane_scene();
  scene.camera = {{0, -30, 0.5f}, {0, 0, 0}, {0, 0, 1}, 0.6f};
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 32, 24});
  for (const SurfaceSample& s : buffer.indirect) ASSERT_TRUE(s.valid);
  EXPECT_EQ(buffer.edge_share(), 0.0);
}

// Two parallel planes, one half a unit in front of the other on the left half of the picture. Red if (both
// tried): a direction of the neighbourhood is left out, or the tolerance is not relative to the distance.
TEST(EdgeMask, AStepBetweenTwoPlanesMarksTheColumnsBesideIt) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  tiny::add_quad(scene, {-9, -9, 0.5f}, {9, 0, 0}, {0, 18, 0});
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 20, 15});
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(buffer.edge[static_cast<size_t>(y * 20 + x)], x == 9 || x == 10) << x << ' ' << y;
  EXPECT_NEAR(buffer.edge_share(), 0.1, 1e-12);
  for (uint8_t e : edge_mask(buffer, 0.2f, 0.9f)) EXPECT_EQ(e, 0);  // 0.5 is less than 0.2 x distance 4
}

// Red if (both tried): normals are not compared, or their tolerance is a sine.
TEST(EdgeMask, ACreaseMarksPixelsOnBothSides) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {0, -9, 0}, {9, 0, -3}, {0, 18, 0});
  tiny::add_quad(scene, {0, -9, 0}, {0, 18, 0}, {-9, 0, -3});
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 20, 15});
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(edge_mask(buffer, 1.0f, 0.9f)[static_cast<size_t>(7 * 20 + x)], x == 9 || x == 10) << x;
    EXPECT_EQ(edge_mask(buffer, 1.0f, 0.7f)[static_cast<size_t>(7 * 20 + x)], 0)
        << x;  // cos of the crease: 0.8
  }
}

// Red if (tried): a neighbour that misses everything isn't a discontinuity.
TEST(EdgeMask, TheSilhouetteAgainstNothingIsAnEdge) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-9, -9, 0}, {9, 0, 0}, {0, 18, 0});
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 20, 15});
  for (int x = 0; x < 20; ++x)
    EXPECT_EQ(buffer.edge[static_cast<size_t>(7 * 20 + x)], x == 9 || x == 10) << x;
}

// A strip a quarter of a pixel wide, before the left sub-samples of one column: no pixel's centre sees it.
// Red if sub-samples are not looked at.
TEST(EdgeMask, AThingThatOnlySubSamplesSeeIsAnEdge) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
  tiny::add_quad(scene, {-0.827f, -9, 0.5f}, {0.04f, 0, 0}, {0, 18, 0});
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 20, 15});
  for (int x = 0; x < 20; ++x) EXPECT_EQ(buffer.edge[static_cast<size_t>(7 * 20 + x)], x == 5) << x;
}

TEST(DeepFrameBuffer, RefusesSizesOutOfRange) {
  const Scene scene = plane_scene();
  const RayTracer tracer(scene);
  EXPECT_THROW(make_deep_frame_buffer(scene, tracer, {scene.camera, 0, 9}), Error);
  EXPECT_THROW(make_deep_frame_buffer(scene, tracer, {scene.camera, 16, 20000}), Error);
}

}  // namespace
}  // namespace relight
