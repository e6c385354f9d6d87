// Shadow maps against traced shadows, away from shadow edges as shadow_edges.h defines them.
#include <gtest/gtest.h>

#include "common/sampling/deep_frame_buffer.h"
#include "common/scene/scene_file.h"
#include "tests/shading/shading_fixture.h"
#include "tests/shading/shadow_edges.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

using test::omni_light;
using test::spot_light;

struct Agreement {
  double away = 0.0;          // share of samples that are away from edges
  double agree = 0.0;         // share of those where map and rays say the same
  double false_shadow = 0.0;  // share of those that only the map darkens
  size_t lit = 0;
  int64_t maps = 0;
};

Agreement agreement(const RayTracer& tracer, const std::vector<SurfaceSample>& samples, const Light& light,
                    int size) {
  const LightingState lighting{"one", {light}};
  const auto context = gpu::Context::create("osmesa");
  DirectLighting shading(*context, tracer.scene(), tracer, {Shadows::map, size});
  StageLog log;
  const auto mapped = test::shade(shading, samples, {}, lighting, Lobes::diffuse, log);
  const auto traced = shade_direct_cpu(tracer, samples, {}, lighting, Lobes::diffuse);
  const std::vector<uint8_t> away = test::away_from_shadow_edges(tracer, samples, light, size);
  size_t considered = 0, wrong = 0, dark = 0;
  Agreement result;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!away[i]) continue;
    const bool in_map = mapped[i] != glm::vec3(0.0f), in_truth = traced[i] != glm::vec3(0.0f);
    ++considered, wrong += in_map != in_truth, dark += in_truth && !in_map, result.lit += in_truth;
  }
  const auto n = static_cast<double>(considered);
  result.away = n / static_cast<double>(samples.size());
  result.agree = 1.0 - static_cast<double>(wrong) / n;
  result.false_shadow = static_cast<double>(dark) / n;
  result.maps = log.counters().at("shadow_maps_rendered");
  return result;
}

// Stated share: 99.95 % of the samples away from edges agree, at most 1 in 10,000 is falsely dark.
void expect_agreement(const Agreement& a, int64_t maps, double least_away = 0.8) {
  EXPECT_GE(a.away, least_away) << "too few samples are away from edges for the test to mean much";
  EXPECT_GE(a.agree, 0.9995);
  EXPECT_LE(a.false_shadow, 1e-4);
  EXPECT_GT(a.lit, 100u);
  EXPECT_EQ(a.maps, maps);
}

class RoomShadows : public ::testing::Test {
 protected:
  Scene scene_ = test::room_scene();
  RayTracer tracer_{scene_};
  std::vector<SurfaceSample> samples_ = test::random_samples(tracer_, 30000);
};

// Red if a cube face is turned, mirrored or missing, or the bias leaves acne.
TEST_F(RoomShadows, OmniAgreesWithTracedShadows) {
  expect_agreement(agreement(tracer_, samples_, omni_light({0.2f, 1.3f, 0.1f}), 512), 6);
}

// Red if the spot's frame, field of view or depth comparison is off.
TEST_F(RoomShadows, SpotAgreesWithTracedShadows) {
  expect_agreement(agreement(tracer_, samples_, spot_light({-1.5f, 1.5f, 1.5f}, {1, -1.2f, -1}, 40.0f), 512),
                   1);
}

// Red if a spot wider than one map can serve is not given the cube (tan 89.5 degrees = 115: 512 texels would
// cover the whole scene with a few).
TEST_F(RoomShadows, ASpotOf179DegreesUsesTheCubeAndAgrees) {
  expect_agreement(
      agreement(tracer_, samples_, spot_light({0.3f, 1.3f, -0.2f}, {0.1f, -1, 0.2f}, 89.5f), 512), 5);
}

// Red if a cone of 0.1 degrees loses its map to rounding. Samples lie in its spot on the floor, half of it
// covered by a box's edge further up.
TEST_F(RoomShadows, ASpotOfATenthOfADegreeStillSeesItsShadow) {
  const glm::vec3 position(-0.6f, 1.9f, -0.7f);
  const Light light = spot_light(position, {0, -1, 0}, 0.05f);
  const float radius = 2.9f * 0.05f * 3.14159265f / 180.0f;
  std::vector<SurfaceSample> samples;
  for (int i = -40; i <= 40; ++i) {
    for (int k = -40; k <= 40; ++k) {
      SurfaceSample s;
      s.position = glm::vec3(-0.6f + radius * 0.025f * static_cast<float>(i), -1.0f,
                             -0.7f + radius * 0.025f * static_cast<float>(k));
      s.shading_normal = s.geometric_normal = {0, 1, 0};
      s.diffuse = glm::vec3(0.5f);
      s.valid = true;
      samples.push_back(s);
    }
  }
  const Agreement a = agreement(tracer_, samples, light, 512);
  EXPECT_GT(a.lit, 1000u);
  EXPECT_GE(a.away, 0.9);
  EXPECT_GE(a.agree, 0.9995);
}

// Red if the near plane cuts the box that the light hangs just above, or its distance is absolute.
TEST_F(RoomShadows, ALightCloseToASurfaceAgrees) {
  expect_agreement(agreement(tracer_, samples_, omni_light({-1.0f, 0.301f, -0.7f}), 512), 6, 0.7);
}

// Red if any bias is absolute: the same room in millimetres and kilometres, and far from the origin.
TEST(Shadows, DoNotDependOnScaleAndPlace) {
  struct Placement {
    float scale;
    glm::vec3 shift;
  };
  for (const Placement& p :
       {Placement{1e-3f, {0, 0, 0}}, Placement{1e3f, {0, 0, 0}}, Placement{1.0f, {300, -500, 200}}}) {
    const Scene scene = test::room_scene(p.scale, p.shift);
    const RayTracer tracer(scene);
    const auto samples = test::random_samples(tracer, 15000);
    SCOPED_TRACE(p.scale);
    const auto place = [&p](const glm::vec3& q) { return p.scale * q + p.shift; };
    expect_agreement(agreement(tracer, samples, omni_light(place({0.2f, 1.3f, 0.1f})), 512), 6, 0.7);
    expect_agreement(
        agreement(tracer, samples, spot_light(place({-1.5f, 1.5f, 1.5f}), {1, -1.2f, -1}, 40.0f), 512), 1,
        0.7);
  }
}

// Red without the slope bias: within half a texel of a concave edge the map holds the other wall. An empty
// room seen from inside has no shadow at all, however coarse the map.
TEST(Shadows, AnEmptyRoomHasNone) {
  Scene scene = tiny::empty_scene();
  tiny::add_box(scene, {-2, -1, -2}, {2, 2, 2});
  finish_scene(scene);
  const RayTracer tracer(scene);
  const std::vector<SurfaceSample> samples = test::random_samples(tracer, 40000);
  const auto context = gpu::Context::create("osmesa");
  for (const int size : {32, 512}) {
    DirectLighting shading(*context, scene, tracer, {Shadows::map, size});
    for (const Light& light :
         {omni_light({0.7f, 0.9f, -1.1f}), spot_light({0.7f, 0.9f, -1.1f}, {-1, -1, 0.8f}, 55.0f)}) {
      StageLog log;
      const auto mapped = test::shade(shading, samples, {}, {"one", {light}}, Lobes::diffuse, log);
      const auto truth = shade_direct_cpu(tracer, samples, {}, {"one", {light}}, Lobes::diffuse);
      size_t dark = 0;
      for (size_t i = 0; i < samples.size(); ++i) {
        dark += mapped[i] == glm::vec3(0.0f) && truth[i] != glm::vec3(0.0f);
      }
      EXPECT_EQ(dark, 0u) << size << ' ' << light.name;
    }
  }
}

// Red if the comparison ignores that depths from a far light are rounded to its distance, not to the scene's
// size.
TEST(Shadows, ALightFarOutsideTheSceneLeavesNoAcne) {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-0.5f, -0.1f, -0.5f}, {0.03f, 0.02f, 1}, {1, 0.2f, 0.01f});
  finish_scene(scene);
  const RayTracer tracer(scene);
  std::vector<SurfaceSample> samples = test::random_samples(tracer, 20000);
  const Agreement a =
      agreement(tracer, samples, spot_light({300, 1000, 200}, {-300, -1000, -200}, 0.06f), 2048);
  EXPECT_EQ(a.false_shadow, 0.0);
  EXPECT_GT(a.lit, 9000u);
}

// Red on shapes the room has not: fluted columns, arches, coarse and fine triangles together.
TEST(Shadows, AgreeOnTheColonnadeForItsOwnLights) {
  const Scene scene = load_scene("colonnade");
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 80, 60});
  for (const char* preset : {"spot", "omni"}) {
    SCOPED_TRACE(preset);
    const Light light = scene.lightings.at(preset).lights.at(0);
    expect_agreement(agreement(tracer, buffer.direct, light, 1024), light.type == LightType::spot ? 1 : 6);
  }
}

}  // namespace
}  // namespace relight
