// Compact samples: what they keep, on the side of the surface that it was on, and the same to shaders.
#include <gtest/gtest.h>

#include "common/sampling/random.h"
#include "common/shading/sample_formats.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

constexpr glm::vec3 eye(1.5f, 0.3f, 1.2f);

struct Bounds {
  SampleFormat format;
  float position;  // of half the extent, a coordinate
  float angle;     // radians
  float albedo;    // of the largest channel of the sample
};
// Spacing of 16-bit floats below 1; of 65,536 steps over twice the half extent; half a step of 1/127 on the
// octahedron in both directions, whose map stretches angles by at most 3 (in the middle of a face); half a
// step of the shared exponent.
const Bounds bounds[] = {{SampleFormat::half, 0x1p-11f, 1e-3f, 0x1p-11f},
                         {SampleFormat::bytes, 0x1p-15f, 0.0168f, 0x1p-8f}};

std::vector<SurfaceSample> samples_in(float scale, const glm::vec3& shift) {
  const Scene scene = test::room_scene(scale, shift);
  const RayTracer tracer(scene);
  std::vector<SurfaceSample> samples = test::random_samples(tracer, 5000);
  for (size_t i = 0; i < samples.size(); ++i)
    samples[i].diffuse =
        std::exp2(-8.0f * random_float(1, 2, i, 0)) *
        glm::vec3(random_float(1, 2, i, 1), random_float(1, 2, i, 2), random_float(1, 2, i, 3));
  return samples;
}

float largest_coordinate(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// At several scales and far from the origin. Red if positions are rounded to nearest (below the surface), a
// normal's sign is lost, or the exponent is one too small (each tried).
TEST(SampleFormats, KeepASampleWithinTheirBoundsAndOnItsSide) {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float shift : {0.0f, 5.0f})
      for (const Bounds& b : bounds) {
        const std::vector<SurfaceSample> samples = samples_in(scale, glm::vec3(shift * scale));
        const CompactSamples stored = compact(samples, b.format);
        EXPECT_EQ(stored.words.size(), samples.size() * (b.format == SampleFormat::half ? 5 : 3));
        const std::vector<SurfaceSample> kept = unpacked(stored);
        const float extent = stored.frame.w;
        EXPECT_NEAR(extent, 2.0f * scale, 0.01f * scale);  // the room is 4 wide
        for (size_t i = 0; i < samples.size(); ++i) {
          const SurfaceSample &s = samples[i], &k = kept[i];
          const glm::vec3 moved = k.position - s.position;
          ASSERT_LE(largest_coordinate(moved), 1.02f * b.position * extent);
          ASSERT_GE(glm::dot(moved, s.shading_normal), -1e-6f * (1.0f + shift) * extent);
          ASSERT_LE(glm::length(k.shading_normal - s.shading_normal), b.angle);
          ASSERT_EQ(k.geometric_normal, k.shading_normal);
          ASSERT_LE(largest_coordinate(k.diffuse - s.diffuse),
                    1.01f * b.albedo * largest_coordinate(s.diffuse) + 1e-7f);
        }
      }
}

// Black, invalid, a single one, none: no division by a zero extent or a zero albedo.
TEST(SampleFormats, TakeWhatHasNoExtent) {
  SurfaceSample s;
  s.position = glm::vec3(3, 4, 5), s.shading_normal = s.geometric_normal = glm::vec3(0, -1, 0),
  s.valid = true;
  SurfaceSample nothing;
  nothing.position = glm::vec3(NAN);
  for (const Bounds& b : bounds) {
    EXPECT_EQ(compact({}, b.format).size(), 0u);
    const std::vector<SurfaceSample> samples = {s, nothing};
    const std::vector<SurfaceSample> kept = unpacked(compact(samples, b.format));
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(kept[0].position - s.position), glm::vec3(1e-5f))));
    EXPECT_EQ(kept[0].diffuse, glm::vec3(0.0f));
    EXPECT_EQ(kept[1].diffuse, glm::vec3(0.0f));
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(kept[1].position - s.position), glm::vec3(1e-5f))));
  }
}

// The shader unpacks what the CPU unpacks: traced shadows are the same bits, so the rest may differ by
// rounding only. Cut into slabs, too. Red if a word is read from the wrong place.
TEST(SampleFormats, ShadeOnTheGpuAsOnTheCpu) {
  const auto context = gpu::Context::create("osmesa");
  const Scene scene = test::room_scene();
  const RayTracer tracer(scene);
  const LightingState lighting{
      "two", {test::omni_light({0.3f, 0.9f, 0.2f}), test::spot_light({-1.2f, 1.1f, -1.0f}, {1, -1, 1}, 30)}};
  for (const Bounds& b : bounds) {
    const CompactSamples stored = compact(test::random_samples(tracer, 20000), b.format);
    DirectLighting shading(*context, scene, tracer, {Shadows::traced, 0});
    StageLog log;
    const GpuSamples on_gpu(stored, eye, 8192);
    EXPECT_EQ(on_gpu.slabs().size(), 3u);
    EXPECT_EQ(on_gpu.bytes(), b.format == SampleFormat::half ? 20 * 20000 : 12 * 20000);
    gpu::Buffer radiance(20000 * 16);
    shading.shade(lighting, {{&on_gpu, Lobes::diffuse, &radiance}}, log);
    std::vector<glm::vec3> gpu;
    for (const glm::vec4& v : radiance.download<glm::vec4>()) gpu.emplace_back(v);
    const std::vector<SurfaceSample> kept = unpacked(stored);
    const auto cpu = shade_direct_cpu(tracer, kept, eye, lighting, Lobes::diffuse);
    EXPECT_LE(test::largest_error(gpu, cpu, test::rounding_scale(kept, lighting)), 2e-6f);
    EXPECT_GT(std::ranges::count_if(cpu, [](const glm::vec3& v) { return v.x > 0.0f; }), 2000);
  }
}

}  // namespace
}  // namespace relight
