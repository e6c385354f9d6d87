#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "common/tracing/ray_tracer.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

std::vector<SurfaceSample> samples_of(const RayTracer& tracer, const glm::vec3& eye, int count) {
  std::vector<SurfaceSample> samples;
  for (uint32_t i = 0; static_cast<int>(samples.size()) < count; ++i) {
    const glm::vec2 u = sobol_2d(i, 11);
    const float z = 1.0f - 2.0f * u.x, r = std::sqrt(1.0f - z * z), phi = 6.2831853f * u.y;
    const glm::vec3 direction(r * std::cos(phi), r * std::sin(phi), z);
    const SurfaceSample sample = tracer.surface(tracer.intersect(eye, direction), direction);
    if (sample.valid) samples.push_back(sample);
  }
  return samples;
}

// Red if: a ray reaches Embree unchecked: the process would abort here (each tried: origin and direction,
// t_far, ends of segments).
TEST(RayTracer, RefusesRaysThatAreNotFinite) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const glm::vec3 o(0.0f), z(0, 0, 1);
  EXPECT_THROW(tracer.intersect({nan, 0, 0}, z), Error);
  EXPECT_THROW(tracer.intersect(o, {0, nan, 1}), Error);
  EXPECT_THROW(tracer.intersect(o, {0, inf, 1}), Error);
  EXPECT_THROW(tracer.intersect(o, z, nan), Error);
  EXPECT_THROW(tracer.intersect(o, z, -1.0f), Error);
  EXPECT_THROW(tracer.visible({0, nan, 0}, z, o, z), Error);
  EXPECT_THROW(tracer.visible(o, {nan, 0, 0}, z, z), Error);
  EXPECT_THROW(tracer.visible_from_point(o, z, {0, 0, inf}), Error);
  glm::vec3 points[16] = {};
  EXPECT_THROW(tracer.visible16(points, {nan, 0, 0}, 0xffffu), Error);
  points[7].x = nan;
  EXPECT_THROW(tracer.visible16(points, z, 0xffffu), Error);
  SegmentFan fan;
  EXPECT_THROW(tracer.visible16(fan, {0, inf, 0}, 0xffffu), Error);
  EXPECT_THROW(fan.set(7, {0, 0, nan}), Error);
}

// Red if (both tried): inactive entries are read, or reported as free.
TEST(RayTracer, PacketsIgnoreInactiveEntries) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  glm::vec3 points[16] = {};
  for (auto& p : points) p = glm::vec3(nan);
  points[3] = {0.1f, 0.5f, 0.5f};
  EXPECT_EQ(tracer.visible16(points, {0.3f, 0.6f, 0.2f}, 1u << 3), 1u << 3);
  EXPECT_EQ(tracer.visible16(points, {0.3f, 0.6f, 0.2f}, 0u), 0u);
}

// Red if: packets and single rays treat an end, the offset or the mask differently (tried: packets end 1 %
// late), or a fan keeps something of the end before (tried: tfar, which Embree writes).
TEST(RayTracer, PacketsAgreeWithSingleSegments) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const auto from = samples_of(tracer, {0.2f, 0.4f, 0.3f}, 1600),
             to = samples_of(tracer, {-0.6f, 0.5f, 0.7f}, 40);
  int disagreements = 0, free_segments = 0, total = 0;
  SegmentFan fan;
  for (const SurfaceSample& q : to)
    for (size_t first = 0; first < from.size(); first += 16) {
      glm::vec3 ends[16];
      uint32_t expected = 0, active = 0;
      // The common end takes one side only, so only points on that side are asked for.
      for (size_t i = 0; i < 16; ++i) {
        const SurfaceSample& p = from[first + i];
        if (glm::dot(q.geometric_normal, p.position - q.position) <= 0.0f ||
            glm::dot(p.geometric_normal, q.position - p.position) <= 0.0f)
          continue;
        active |= 1u << i;
        ends[i] = tracer.offset_point(p.position, p.geometric_normal);
        fan.set(static_cast<unsigned>(i), ends[i]);
        if (tracer.visible(p.position, p.geometric_normal, q.position, q.geometric_normal))
          expected |= 1u << i;
      }
      const glm::vec3 end = tracer.offset_point(q.position, q.geometric_normal);
      const uint32_t found = tracer.visible16(ends, end, active);
      ASSERT_EQ(tracer.visible16(fan, end, active), found);
      disagreements += __builtin_popcount(found ^ expected);
      free_segments += __builtin_popcount(found), total += __builtin_popcount(active);
    }
  // Embree's packet and single kernels may round a ray through a shared edge differently.
  EXPECT_LE(disagreements, total / 20000);
  EXPECT_GT(free_segments, total / 4);
  EXPECT_LT(free_segments, total * 99 / 100);
}

// Red if (both tried): the offset is too small (self-shadowing) or taken to the wrong side.
TEST(RayTracer, SurfacesDoNotShadowThemselvesAtAnyScaleOrPlace) {
  for (float size : {2e-3f, 2.0f, 2e3f})
    for (float away : {0.0f, 100.0f}) {
      Scene scene = tiny::empty_scene();
      const glm::vec3 centre = glm::vec3(1.0f, -0.7f, 0.4f) * (away * size);
      tiny::add_sphere(scene, centre, 0.5f * size, 40);
      finish_scene(scene);
      const RayTracer tracer(scene);
      int dark = 0;
      const glm::vec3 light = centre + glm::vec3(0.0f, 0.0f, 3.0f * size);
      const auto samples = samples_of(tracer, centre + glm::vec3(0.0f, 0.0f, 2.0f * size), 4000);
      for (const SurfaceSample& s : samples) {
        // Facets at grazing angles may be shadowed by their convex neighbours' rounding; leave them out.
        if (glm::dot(s.geometric_normal, glm::normalize(light - s.position)) < 0.05f) continue;
        dark += !tracer.visible_from_point(s.position, s.geometric_normal, light);
        dark +=
            !tracer.visible_from_point(s.position, -s.geometric_normal, light);  // either orientation will do
      }
      EXPECT_EQ(dark, 0) << "size " << size << ", " << away << " sizes away";
    }
}

// Red if (tried): the offset is so large that it jumps over what lies near.
TEST(RayTracer, ASheetCloseToASurfaceStillShadowsIt) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  tiny::add_quad(scene, {-1, -1, 1e-4f}, {2, 0, 0}, {0, 2, 0});
  finish_scene(scene);
  const RayTracer tracer(scene);
  EXPECT_FALSE(tracer.visible_from_point({0.1f, 0.2f, 0.0f}, {0, 0, 1}, {0.3f, 0.1f, 2.0f}));
  EXPECT_TRUE(tracer.visible_from_point({0.1f, 0.2f, 1e-4f}, {0, 0, 1}, {0.3f, 0.1f, 2.0f}));
}

// Red if (both tried): t isn't in units of the direction's length, or t_far isn't respected.
TEST(RayTracer, DistancesAreInUnitsOfTheDirection) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  finish_scene(scene);
  const RayTracer tracer(scene);
  const Hit hit = tracer.intersect({0, 0, 3}, {0, 0, -2});
  ASSERT_TRUE(hit.valid);
  EXPECT_NEAR(hit.t, 1.5f, 1e-6f);
  EXPECT_FALSE(tracer.intersect({0, 0, 3}, {0, 0, -2}, 1.4f).valid);
  EXPECT_FALSE(tracer.intersect({0, 0, 3}, {0, 0, 2}).valid);
}

// Red if (both tried): barycentrics are given to the wrong vertices, or normals don't face the viewer.
TEST(RayTracer, SurfaceInterpolatesAndFacesTheSideItWasSeenFrom) {
  Scene scene = tiny::empty_scene(glm::vec3(0.3f, 0.2f, 0.1f));
  const uint32_t a = tiny::add_vertex(scene, {0, 0, 0}, glm::normalize(glm::vec3(-1, 0, 2)));
  const uint32_t b = tiny::add_vertex(scene, {1, 0, 0}, glm::normalize(glm::vec3(1, 0, 2)));
  const uint32_t c = tiny::add_vertex(scene, {0, 1, 0}, glm::normalize(glm::vec3(0, 1, 1)));
  tiny::add_triangle(scene, a, b, c);
  finish_scene(scene);
  const RayTracer tracer(scene);
  const glm::vec3 target(0.5f, 0.2f, 0.0f);
  const glm::vec3 n =
      glm::normalize(0.3f * scene.normals[a] + 0.5f * scene.normals[b] + 0.2f * scene.normals[c]);
  for (float z : {1.0f, -1.0f}) {
    const glm::vec3 eye(0.2f, 0.3f, 3.0f * z);
    const SurfaceSample s = tracer.surface(tracer.intersect(eye, target - eye), target - eye);
    ASSERT_TRUE(s.valid);
    EXPECT_LT(glm::length(s.position - target), 1e-6f);
    EXPECT_LT(glm::length(s.geometric_normal - glm::vec3(0, 0, z)), 1e-6f);
    EXPECT_LT(glm::length(s.shading_normal - z * n), 1e-5f);
    EXPECT_EQ(s.diffuse, glm::vec3(0.3f, 0.2f, 0.1f));
  }
}

// Red if (tried): a shading normal that points to the other side of its triangle is passed on.
TEST(RayTracer, ShadingNormalsAreTurnedToTheGeometricSide) {
  Scene scene = tiny::empty_scene();
  for (float z : {-1.0f, 0.0f}) {
    scene = tiny::empty_scene();
    tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    for (auto& n : scene.normals) n = glm::normalize(glm::vec3(1.0f, 0.0f, z));
    finish_scene(scene);
    const RayTracer tracer(scene);
    const SurfaceSample s = tracer.surface(tracer.intersect({0, 0, 1}, {0, 0, -1}), {0, 0, -1});
    EXPECT_GT(glm::dot(s.shading_normal, s.geometric_normal), 0.0f) << z;
  }
}

}  // namespace
}  // namespace relight
