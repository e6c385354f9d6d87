// The GPU, the plain CPU twin and the CPU's blocks give the same light, for every type of light.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "common/shading/block_lighting.h"
#include "common/shading/direct_lighting.h"
#include "tests/lights/light_cases.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

const glm::vec3 eye(0.3f, 0.4f, 1.8f);

struct Room {
  Scene scene = test::room_scene();
  RayTracer tracer{scene};
  std::vector<SurfaceSample> samples = test::random_samples(tracer, 8003);  // the last block is not full
};

// Neighbours in space that face the same way come to lie in one block, so that blocks can be skipped.
void sort_by_place(std::vector<SurfaceSample>& samples) {
  const auto place = [](const SurfaceSample& s) {
    const glm::ivec3 n(glm::round(2.0f * s.geometric_normal)), p(glm::floor(3.0f * s.position));
    return std::array{n.x, n.y, n.z, p.x, p.y, p.z};
  };
  std::stable_sort(samples.begin(), samples.end(),
                   [&](const SurfaceSample& a, const SurfaceSample& b) { return place(a) < place(b); });
}

size_t lit(const std::vector<glm::vec3>& radiance) {
  size_t n = 0;
  for (const glm::vec3& r : radiance) n += r != glm::vec3(0.0f);
  return n;
}

// The lights as they are, and without shadows where they can be: light from outside then falls into the
// closed room, onto its glossy sphere.
std::vector<Light> with_and_without_shadows() {
  std::vector<Light> lights = test::light_cases();
  for (Light light : test::light_cases()) {
    light.name += " without shadows", light.casts_shadows = false;
    if (!has_area(light.type)) lights.push_back(light);
  }
  return lights;
}

// Traced shadows on both. Stated bound: 1e-6 (16 roundings) of rounding_scale_of. Red if (tried): the GPU
// leaves out the emitter's cosine; takes a directional light's place for its direction; reads a wrong
// row of the slide.
TEST(EveryLight, IsTheSameOnTheGpuAndItsCpuTwin) {
  const auto context = gpu::Context::create("osmesa");
  const Room room;
  DirectLighting shading(*context, room.scene, room.tracer, {Shadows::traced, 0});
  for (const Light& light : with_and_without_shadows()) {
    SCOPED_TRACE(light.name);
    const auto scale = test::rounding_scale_of(room.samples, emitters_of(light, 16, room.tracer.offset()));
    for (const Lobes lobes : {Lobes::diffuse, Lobes::all}) {
      StageLog log;
      const auto gpu = test::shade(shading, room.samples, eye, {"one", {light}}, lobes, log);
      const auto cpu = shade_direct_cpu(room.tracer, room.samples, eye, {"one", {light}}, lobes);
      EXPECT_GT(lit(cpu), 100u);
      EXPECT_LE(test::largest_error(gpu, cpu, scale), 1e-6f);
    }
  }
}

// Bit by bit. Red if (tried): culling by bounds takes a directional light for one at the origin; cones are
// culled by half their angle.
TEST(EveryLight, IsTheSameInBlocksBitByBit) {
  Room room;
  sort_by_place(room.samples);
  const SampleBlocks blocks(room.samples, sequential_order(room.samples.size()), eye);
  for (const Light& light : with_and_without_shadows()) {
    SCOPED_TRACE(light.name);
    for (const int n : {1, 16}) {
      BlockLighting lighting(room.tracer, n);
      std::vector<glm::vec4> out(blocks.count() * block_lanes);
      StageLog log;
      lighting.shade({&light, 1}, {{&blocks, Lobes::all, 1, out}}, Onto::nothing, log);
      const auto plain = shade_direct_cpu(room.tracer, room.samples, eye, {"one", {light}}, Lobes::all, n);
      for (size_t i = 0; i < plain.size(); ++i) ASSERT_EQ(glm::vec3(out[i]), plain[i]) << i;
      EXPECT_GT(log.counters().at("shading_blocks_culled"), static_cast<int64_t>(blocks.count()) / 20);
    }
  }
}

// Only what is needed. Red if (tried): maps are rendered whatever casts_shadows says.
TEST(EveryLight, CostsShadowMapsOnlyIfItCastsShadows) {
  const auto context = gpu::Context::create("osmesa");
  const Room room;
  DirectLighting shading(*context, room.scene, room.tracer, {Shadows::map, 64, 3});
  for (Light light : test::light_cases()) {
    SCOPED_TRACE(light.name);
    const auto maps = [&] {
      StageLog log;
      const auto radiance = test::shade(shading, room.samples, eye, {"one", {light}}, Lobes::diffuse, log);
      EXPECT_GT(lit(radiance), 100u);
      return log.counters().contains("shadow_maps_rendered") ? log.counters().at("shadow_maps_rendered") : 0;
    };
    const int64_t with = maps();
    EXPECT_EQ(with, light.type == LightType::omni ? 6 : has_area(light.type) ? 3 * 5 : 1);
    if (has_area(light.type)) continue;  // these always cast shadows
    light.casts_shadows = false;
    EXPECT_EQ(maps(), 0);
  }
}

}  // namespace
}  // namespace relight
