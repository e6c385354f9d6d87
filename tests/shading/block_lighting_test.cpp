// The CPU's fast direct lighting against its plain twin, which it must equal bit by bit: same light models,
// same shadow rays, same order of sums.
#include "common/shading/block_lighting.h"

#include <cstring>

#include <gtest/gtest.h>

#include "common/brdf/brdf_lobes.h"
#include "common/run/error.h"
#include "common/run/thread_limit.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/reconstruction.h"
#include "common/shading/traced_visibility.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

using test::omni_light;
using test::spot_light;

const glm::vec3 eye(0.3f, 0.4f, 1.8f);

std::vector<Light> two_lights() {
  return {omni_light({0.2f, 1.5f, 0.1f}), spot_light({-1.5f, 1.5f, 1.5f}, {1, -1.2f, -1}, 35.0f)};
}

// Cones from a tenth of a degree to nearly a half-space, lights far away, in the air, in a surface and in a
// solid.
std::vector<Light> hard_lights() {
  std::vector<Light> lights = two_lights();
  for (const float half_angle : {0.05f, 1.0f, 20.0f, 70.0f, 89.5f})
    for (const glm::vec3& p : {glm::vec3(0.3f, 1.7f, 0.2f), glm::vec3(1.9f, 0.5f, 1.9f)})
      lights.push_back(spot_light(p, {-0.4f, -1.0f, -0.3f}, half_angle));
  lights.push_back(omni_light({-1.0f, -0.5f, -0.7f}));
  lights.push_back(omni_light({1.0f, -0.19f, 0.0f}));
  lights.push_back(omni_light({40.0f, 30.0f, -20.0f}));
  return lights;
}

struct Room {
  Scene scene = test::room_scene();
  RayTracer tracer{scene};
  std::vector<SurfaceSample> samples = test::random_samples(tracer, 20003);  // the last block is not full
};

std::vector<glm::vec4> shade(const Room& room, const std::vector<SurfaceSample>& samples,
                             const std::vector<Light>& lights, Lobes lobes, StageLog& log) {
  const SampleBlocks blocks(samples, sequential_order(samples.size()), eye);
  BlockLighting lighting(room.tracer);
  std::vector<glm::vec4> out(blocks.count() * block_lanes, glm::vec4(-1.0f));
  lighting.shade(lights, {{&blocks, lobes, 1, out}}, Onto::nothing, log);
  out.resize(samples.size());
  return out;
}

size_t expect_equal(const std::vector<glm::vec4>& got, const std::vector<glm::vec3>& expected) {
  size_t lit = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (glm::vec3(got[i]) != expected[i]) {
      ADD_FAILURE() << "sample " << i << ": " << got[i].x << " instead of " << expected[i].x;
      return 0;
    }
    lit += expected[i] != glm::vec3(0.0f);
  }
  return lit;
}

// Red if culling hides a lit block, lanes are mixed up or a formula is restated (tried: culling with half the
// radius).
TEST(BlockLighting, EqualsThePlainTwinBitByBitUnderEveryLight) {
  const Room room;
  for (const Light& light : hard_lights()) {
    StageLog log;
    const auto got = shade(room, room.samples, {light}, Lobes::diffuse, log);
    expect_equal(got, shade_direct_cpu(room.tracer, room.samples, eye, {"", {light}}, Lobes::diffuse));
    int64_t rays = 0;
    traced_visibility(room.tracer, room.samples, emitter_of(light), rays);
    EXPECT_EQ(log.counters().at("shadow_rays"), rays) << "a sample that no light can reach cost a ray";
  }
}

// Red if a model's parameters, the eye or the Lambert part of a glossy block get lost (tried: glossy blocks
// shaded by their diffuse part; brdf of lane 0 for all lanes).
TEST(BlockLighting, EqualsThePlainTwinBitByBitForEveryModel) {
  const Room room;
  const LafortuneLobe lobes[2] = {{-1, -0.8f, 1, 30, glm::vec3(0.3f)}, {0.5f, 0.5f, 1, 6, glm::vec3(0.2f)}};
  for (const GlossyPart& part :
       {phong_part(glm::vec3(0.5f), 20), ashikhmin_shirley_part(glm::vec3(0.3f), 10, 200),
        lafortune_part(lobes), ggx_part(glm::vec3(0.4f), 0.3f, 0.05f)}) {
    std::vector<SurfaceSample> samples = room.samples;
    for (size_t i = 0; i < samples.size(); i += 3) {
      samples[i].glossy = part.glossy, samples[i].exponent = part.exponent;
      samples[i].shape = part.shape, samples[i].shape.tangent = float(i % 7) - 3.0f;
    }
    StageLog log;
    const auto got = shade(room, samples, two_lights(), Lobes::all, log);
    const LightingState state{"", two_lights()};
    EXPECT_GT(expect_equal(got, shade_direct_cpu(room.tracer, samples, eye, state, Lobes::all)), 1000u);
  }
}

// Red if culling hides a lit block, or no longer culls (tried: nothing culled). The blocks here are
// neighbours in an image, as the random samples above are not.
TEST(BlockCulling, SkipsMostBlocksOutsideANarrowConeAndNoneThatIsLit) {
  const Room room;
  const View view{room.scene.camera, 96, 64};
  const DeepFrameBuffer buffer = make_deep_frame_buffer(room.scene, room.tracer, view);
  const SampleBlocks blocks(buffer.direct, pixel_quad_order(96, 64), eye);
  for (const Light& light : hard_lights()) {
    const Emitter emitter = emitter_of(light);
    const BlockCulling culling(emitter);
    size_t dark = 0, culled = 0;
    for (size_t b = 0; b < blocks.count(); ++b) {
      const bool lit = lit_lanes(emitter, blocks.geometry(b)) != 0,
                 kept = culling.may_be_lit(blocks.bounds(b));
      ASSERT_TRUE(kept || !lit) << "block " << b << ", cone of " << light.outer_degrees << " degrees";
      dark += !lit, culled += !kept;
    }
    EXPECT_GE(culled * 4, dark * 3) << "cone of " << light.outer_degrees << " degrees";
  }
}

// Red if the four lanes of a pixel are not its own, odd sizes shift rows, or sums are taken in another order
// (tried: x and y of pixel_quad_order exchanged; resolve taking a wrong row of the quad).
TEST(FusedReconstruction, EqualsThePlainTwinsBitByBitOnAnOddView) {
  const Room room;
  View view{room.scene.camera, 77, 45};
  view.camera.eye = {0.2f, 0.3f, 1.9f};
  const DeepFrameBuffer buffer = make_deep_frame_buffer(room.scene, room.tracer, view);
  const SampleBlocks blocks(buffer.direct, pixel_quad_order(77, 45), eye);
  const FusedReconstruction reconstruction(buffer);
  BlockLighting lighting(room.tracer);
  StageLog log;
  std::vector<glm::vec4> direct(reconstruction.direct_values());
  lighting.shade(two_lights(), {{&blocks, Lobes::all, 4, direct}}, Onto::nothing, log);
  std::vector<glm::vec4> indirect;
  std::vector<glm::vec3> indirect3;
  for (size_t i = 0; i < buffer.indirect.size(); ++i) {
    indirect.emplace_back(std::sin(float(i)) + 1.0f, float(i % 17), 0.3f, 0.0f);
    indirect3.emplace_back(indirect.back());
  }
  const auto images = reconstruction.resolve(direct, indirect, log);
  const Image expected_indirect = reconstruct_indirect_cpu(buffer, closest_view_samples(buffer), indirect3);
  // One light at a time: the twin sums lights before it filters.
  for (size_t i = 0; i < images.total.pixels.size(); ++i) {
    ASSERT_EQ(images.indirect.pixels[i], expected_indirect.pixels[i]) << i;
    ASSERT_EQ(images.total.pixels[i], images.direct.pixels[i] + images.indirect.pixels[i]) << i;
  }
  for (const Light& light : two_lights()) {
    const LightingState one{"", {light}};
    const Image expected =
        box_filter_2x2(shade_direct_cpu(room.tracer, buffer.direct, eye, one, Lobes::all), 77, 45);
    lighting.shade(one.lights, {{&blocks, Lobes::all, 4, direct}}, Onto::nothing, log);
    const Image got = reconstruction.resolve(direct, indirect, log).direct;
    for (size_t i = 0; i < got.pixels.size(); ++i) ASSERT_EQ(got.pixels[i], expected.pixels[i]) << i;
  }
}

// Red if a NaN or infinity reaches the picture, or is replaced without a word (tried: without replacing).
TEST(BlockLighting, RadianceBeyondFloatIsReplacedAndReported) {
  const Room room;
  Light light = omni_light(room.samples[40].position + room.samples[40].geometric_normal * 1e-3f);
  light.intensity = glm::vec3(3e38f);
  light.casts_shadows = false;
  StageLog log;
#ifdef NDEBUG
  const auto got = shade(room, room.samples, {light}, Lobes::diffuse, log);
  EXPECT_EQ(got[40], glm::vec4(0.0f));
  for (const glm::vec4& v : got) ASSERT_TRUE(std::isfinite(v.x + v.y + v.z));
  EXPECT_GT(log.counters().at("non_finite_direct_shading"), 0);
  ASSERT_EQ(log.warnings().size(), 1u);
#else
  EXPECT_THROW(shade(room, room.samples, {light}, Lobes::diffuse, log), Error);
#endif
}

TEST(FusedReconstruction, NonFinitePixelsAreReplacedAndReported) {
  const Room room;
  const View view{room.scene.camera, 16, 8};
  const DeepFrameBuffer buffer = make_deep_frame_buffer(room.scene, room.tracer, view);
  const FusedReconstruction reconstruction(buffer);
  std::vector<glm::vec4> direct(reconstruction.direct_values()), indirect(buffer.indirect.size());
  direct[4 * 9 + 3].y = std::numeric_limits<float>::infinity();  // quad (1, 1), its lower right: pixel (3, 3)
  StageLog log;
#ifdef NDEBUG
  const auto images = reconstruction.resolve(direct, indirect, log);
  EXPECT_EQ(images.direct.at(3, 3), glm::vec3(0.0f));
  EXPECT_EQ(images.total.at(3, 3), glm::vec3(0.0f));
  EXPECT_EQ(log.counters().at("non_finite_reconstruction"), 1);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].find("x = 3, y = 3"), std::string::npos) << log.warnings()[0];
#else
  EXPECT_THROW(reconstruction.resolve(direct, indirect, log), Error);
#endif
}

// Red if a thread's share of the work shows in the result.
TEST(BlockLighting, GivesTheSameBitsForAnyNumberOfThreads) {
  const Room room;
  std::vector<std::vector<glm::vec4>> results;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    StageLog log;
    results.push_back(shade(room, room.samples, two_lights(), Lobes::all, log));
  }
  for (size_t i = 1; i < results.size(); ++i)
    EXPECT_EQ(std::memcmp(results[0].data(), results[i].data(), results[0].size() * sizeof(glm::vec4)), 0);
}

// Red if invalid samples shade to anything but zero, old light shows through, or a black light costs work.
TEST(BlockLighting, InvalidSamplesAndBlackLightsGiveBlackAndCostNothing) {
  const Room room;
  std::vector<SurfaceSample> invalid(100, room.samples[0]);
  for (SurfaceSample& s : invalid) s.valid = false;
  StageLog log, dark;
  for (const glm::vec4& v : shade(room, invalid, two_lights(), Lobes::all, log))
    ASSERT_EQ(v, glm::vec4(0.0f));
  EXPECT_EQ(log.counters().at("shadow_rays"), 0);
  Light black = omni_light({0, 1, 0});
  black.intensity = glm::vec3(0.0f);
  for (const glm::vec4& v : shade(room, room.samples, {black}, Lobes::all, dark))
    ASSERT_EQ(v, glm::vec4(0.0f));
  EXPECT_TRUE(dark.counters().empty() && dark.stages().empty());
}

}  // namespace
}  // namespace relight
