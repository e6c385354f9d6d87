// The direct image of direct-to-indirect transfer against the reference's, for every type of light, on a
// built-in scene.
#include <gtest/gtest.h>

#include "common/lights/light_animation.h"
#include "common/scene/scene_file.h"
#include "reference/path_tracer.h"
#include "tests/lights/light_cases.h"
#include "tests/shading/shading_fixture.h"
#include "tests/support/transfer_bench.h"

namespace relight {
namespace {

// In the cornell box, 2 x 2 x 2 and open in front. The rectangle hangs in the plane of the ceiling.
std::vector<Light> cornell_lights() {
  return {test::omni_light({0.0f, 1.75f, 0.2f}),
          test::spot_light({0.0f, 1.9f, 0.3f}, glm::normalize(glm::vec3(-0.45f, -1.9f, 0.3f)), 20.0f),
          test::directional_light({0.3f, -0.6f, -1.0f}),
          test::rectangle_light({0.0f, 2.0f, 0.1f}, {0.4f, 0, 0}, {0, 0, 0.3f}),
          test::disc_light({-0.8f, 1.4f, 0.5f}, {1, -0.5f, -0.3f}, 0.25f),
          test::projector_light({0.2f, 1.6f, 0.9f}, {-0.2f, -0.8f, -1}),
          test::uber_light({0.2f, 1.6f, 0.9f}, {-0.2f, -0.8f, -1})};
}

Image reference_direct(const test::TransferBench& bench, const LightingState& lighting) {
  PathTracerSettings settings;
  settings.samples_per_pixel = settings.batches = 2;
  Progress quiet(true);
  StageLog log;
  return path_trace(bench.tracer, bench.buffer, lighting, settings, quiet, log).direct;
}

// Stated bounds on |A - R| / |R| of the direct image: 1e-5 for lights of one point or direction with traced
// shadows (rounding, and rays that graze), 0.1 with maps of 1024 texels (edges that are a texel off, in 1 %
// of the picture; what maps do elsewhere is tested with them); with an area and 64 points 0.02 (the
// reference's own noise is 0.01). Red if (tried): the method takes the light of an area without its lift from
// the ceiling; the reference counts rectangles twice.
TEST(EveryLight, GivesTheDirectImageOfTheReference) {
  test::TransferBench bench(load_scene("cornell"));
  const auto cpu = bench.prepare({{"device", "cpu"}, {"area_light_samples", "64"}});
  const auto traced = bench.prepare({{"shadows", "traced"}, {"area_light_samples", "64"}});
  const auto mapped = bench.prepare({{"shadow_map_size", "1024"}, {"area_light_samples", "64"}});
  for (const Light& light : cornell_lights()) {
    SCOPED_TRACE(light.name);
    const LightingState lighting{"one", {light}};
    const Image reference = reference_direct(bench, lighting);
    ASSERT_GT(test::norm(reference), 0.0);
    const double exact = has_area(light.type) ? 0.02 : 1e-5;
    StageLog log;
    EXPECT_LT(test::relative_difference(cpu->relight(lighting, log).direct, reference), exact);
    EXPECT_LT(test::relative_difference(traced->relight(lighting, log).direct, reference), exact);
    EXPECT_LT(test::relative_difference(mapped->relight(lighting, log).direct, reference), 0.1);
  }
}

// With shadows, on a whole picture. The error falls with the number of points; 1024 of them are within the
// reference's own noise, of which its variance tells. Red if points fill half of the disc.
TEST(AreaLight, ConvergesToTheReferenceAsItsPointsGrow) {
  test::TransferBench bench(load_scene("cornell"));
  for (const Light& light : {cornell_lights()[3], cornell_lights()[4]}) {
    SCOPED_TRACE(light.name);
    const LightingState lighting{"one", {light}};
    PathTracerSettings settings;
    settings.samples_per_pixel = settings.batches = 2;
    settings.area_samples = 1024;
    settings.paths.max_bounces = 1;
    Progress quiet(true);
    StageLog log;
    const Image reference = path_trace(bench.tracer, bench.buffer, lighting, settings, quiet, log).direct;
    std::vector<double> errors;
    for (const char* points : {"1", "16", "1024"}) {
      const auto method = bench.prepare({{"device", "cpu"}, {"area_light_samples", points}});
      errors.push_back(test::relative_difference(method->relight(lighting, log).direct, reference));
    }
    EXPECT_LT(errors[1], 0.5 * errors[0]);
    EXPECT_LT(errors[2], 0.2 * errors[1]);
    EXPECT_LT(errors[2], 2.5e-3) << "noise of the reference: about 1e-3";
  }
}

// However many points it has, it is one light of the cache. Red if the cache is asked for emitters.
TEST(AreaLight, IsOneLightOfTheLightCache) {
  test::TransferBench bench(load_scene("cornell"), 16, 12);
  const auto method = bench.prepare({{"device", "cpu"}});
  LightingState lighting{"two", {cornell_lights()[3], cornell_lights()[0]}};
  std::vector<int64_t> shaded;
  for (int frame = 0; frame < 5; ++frame) {
    lighting.lights[1].position.x += 0.1f;
    StageLog log;
    method->relight(lighting, log);
    shaded.push_back(log.counters().at("lights_shaded"));
  }
  EXPECT_EQ(shaded, (std::vector<int64_t>{2, 2, 1, 1, 1}));
}

// Frames of an animated lighting in order, on both devices. The lamp that stands still is shaded twice and
// then kept; before the first and after the last keyframe everything stands. Red if lights without
// tracks get new bits (tried); maps of the standing lamp are rendered again.
TEST(AnimatedLighting, CostsTheMovingLightOnly) {
  test::TransferBench bench(load_scene(std::string(RELIGHT_SOURCE_DIR) + "/scenes/cornell_lights.toml"), 16,
                            12);
  const LightingState sweep = bench.scene.lightings.at("sweep");
  for (const char* device : {"cpu", "gpu"}) {
    const auto method = bench.prepare({{"device", device}, {"shadow_map_size", "64"}});
    std::vector<int64_t> shaded, maps;
    for (const double time : {0.5, 1.0, 1.5, 2.0, 2.5, 4.0, 4.5, 5.0}) {
      StageLog log;
      method->relight(lighting_at(sweep, time), log);
      shaded.push_back(log.counters().at("lights_shaded"));
      const auto found = log.counters().find("shadow_maps_rendered");
      maps.push_back(found == log.counters().end() ? 0 : found->second);
    }
    EXPECT_EQ(shaded, (std::vector<int64_t>{2, 2, 1, 1, 1, 1, 1, 0})) << device;
    if (std::string(device) == "gpu") {
      EXPECT_EQ(maps, (std::vector<int64_t>{7, 7, 1, 1, 1, 1, 1, 0}));
    }
  }
}

}  // namespace
}  // namespace relight
