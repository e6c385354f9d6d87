#include "common/shading/reconstruction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "common/gpu/context.h"
#include "common/run/error.h"
#include "common/run/stage_log.h"
#include "common/sampling/random.h"
#include "common/shading/fused_reconstruction.h"
#include "tests/gpu/contexts.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

constexpr uint32_t nothing = 0xffffffffu;

SurfaceSample sample_at(const glm::vec3& position, const glm::vec3& normal) {
  SurfaceSample s;
  s.position = position;
  s.shading_normal = s.geometric_normal = normal;
  s.valid = true;
  return s;
}

// What a camera at (0, 0, 10) sees of a scene that `hit` gives by its screen coordinates in pixels.
template <typename F>
DeepFrameBuffer buffer_of(int width, int height, F hit) {
  DeepFrameBuffer buffer;
  buffer.view.camera.eye = {0, 0, 10};
  buffer.view.width = width;
  buffer.view.height = height;
  const auto at = [&](int n, std::vector<SurfaceSample>& out) {
    for (int y = 0; y < n * height; ++y) {
      for (int x = 0; x < n * width; ++x) {
        const auto centre = [n](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(n); };
        out.push_back(hit(centre(x), centre(y)));
      }
    }
  };
  at(1, buffer.indirect);
  at(2, buffer.direct);
  return buffer;
}

// A near panel left of x = 4.6 pixels, a far wall behind it: the edge cuts through pixel 4.
DeepFrameBuffer depth_edge(int width, int height) {
  return buffer_of(width, height, [](float x, float y) {
    return sample_at({x * 0.1f, -y * 0.1f, x < 4.6f ? 5.0f : -5.0f}, {0, 0, 1});
  });
}

std::vector<glm::vec3> random_values(size_t n, uint64_t seed) {
  std::vector<glm::vec3> values;
  for (uint64_t i = 0; i < n; ++i) {
    values.emplace_back(random_float(seed, 0, i, 0), random_float(seed, 0, i, 1),
                        100.0f * random_float(seed, 0, i, 2));
  }
  return values;
}

gpu::Buffer on_gpu(const std::vector<glm::vec3>& values) {
  std::vector<glm::vec4> padded;
  for (const glm::vec3& v : values) padded.emplace_back(v, 0.0f);
  return gpu::Buffer::from(padded);
}

void expect_equal(const Image& a, const Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (size_t i = 0; i < a.pixels.size(); ++i) ASSERT_EQ(a.pixels[i], b.pixels[i]) << "pixel " << i;
}

// Red if rows, columns or slabs are mixed up, or the sums are taken in another order. Exact: sums and a
// quarter only.
TEST(Reconstruction, GpuEqualsCpuBitByBit) {
  const Scene scene = test::room_scene();
  const RayTracer tracer(scene);
  View view;
  view.camera.eye = {0.2f, 0.3f, 1.9f};
  view.width = 77, view.height = 45;  // odd: nothing divides evenly
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, view);
  const auto direct = random_values(buffer.direct.size(), 1),
             indirect = random_values(buffer.indirect.size(), 2);
  const Image cpu_direct = box_filter_2x2(direct, view.width, view.height);
  const Image cpu_indirect = reconstruct_indirect_cpu(buffer, closest_view_samples(buffer), indirect);
  const auto check = [&] {
    StageLog log;
    const auto images = Reconstruction(buffer).resolve(on_gpu(direct), on_gpu(indirect), log);
    expect_equal(images.direct, cpu_direct);
    expect_equal(images.indirect, cpu_indirect);
    EXPECT_EQ(log.stages().at(0).first, "reconstruction");
  };
  const auto osmesa = gpu::Context::create("osmesa");
  check();
  std::string reason;
  if (const auto egl = test::egl_or_null(reason)) check();
}

// The exact twin of upsampling, on the GPU and in one pass on the CPU. Red if a sub-sample takes its
// neighbour's value (tried: rows of the grid swapped) or a miss gives light.
TEST(Reconstruction, WithoutUpsamplingEachSubsampleHasItsOwnValue) {
  const auto context = gpu::Context::create("osmesa");
  const DeepFrameBuffer buffer = buffer_of(13, 6, [](float x, float y) {
    return x < 7.6f ? sample_at({x * 0.1f, -y * 0.1f, 0}, {0, 0, 1}) : SurfaceSample{};
  });
  auto values = random_values(buffer.direct.size(), 2);
  for (size_t i = 0; i < values.size(); ++i)
    if (!buffer.direct[i].valid) values[i] = glm::vec3(0.0f);
  const Image expected = box_filter_2x2(values, 13, 6);
  StageLog log;
  const auto gpu = Reconstruction(buffer, Upsampling::none).resolve(on_gpu(values), on_gpu(values), log);
  expect_equal(gpu.indirect, expected);
  const FusedReconstruction fused(buffer, Upsampling::none);
  std::vector<glm::vec4> padded;
  for (const glm::vec3& v : values) padded.emplace_back(v, 0.0f);
  const std::vector<glm::vec4> no_direct(fused.direct_values(), glm::vec4(0.0f));
  expect_equal(fused.resolve(no_direct, padded, log).indirect, expected);
}

// A panel so narrow that no pixel's centre sees it. Red if a sub-sample on it takes the wall's value, one of
// the wall gets a row of its own, two share a place, or GPU and CPU count own values differently.
TEST(Reconstruction, SubsamplesThatMatchNoPixelHaveAValueOfTheirOwn) {
  const auto context = gpu::Context::create("osmesa");
  const DeepFrameBuffer buffer = buffer_of(13, 6, [](float x, float y) {
    const bool panel = x > 5.6f && x < 5.9f;
    return sample_at({x * 0.1f, -y * 0.1f, 0}, panel ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
  });
  const IndirectSources sources = indirect_sources(buffer, Upsampling::edges);
  EXPECT_EQ(sources.width, 13);
  EXPECT_EQ(sources.height, 8 + 4) << "six rows, two left over to a multiple of four, one row of tiles";
  ASSERT_EQ(sources.own.size(), 12u) << "one of the two sub-samples of a pixel's row";
  const std::vector<SurfaceSample> samples = sources.samples(buffer);
  std::set<uint32_t> places;
  for (const auto& own : sources.own) {
    places.insert(own.place);
    EXPECT_GE(own.place, 13u * 8u);
    EXPECT_EQ(samples[own.place].shading_normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(sources.of[own.subsample], own.place);
  }
  EXPECT_EQ(places.size(), 12u);
  const auto values = random_values(samples.size(), 2);
  std::vector<glm::vec3> subsamples;
  for (const uint32_t source : sources.of) subsamples.push_back(values[source]);
  const Image expected = box_filter_2x2(subsamples, 13, 6);
  StageLog log;
  const auto no_light = on_gpu(std::vector<glm::vec3>(buffer.direct.size(), glm::vec3(0.0f)));
  expect_equal(Reconstruction(buffer, Upsampling::edges).resolve(no_light, on_gpu(values), log).indirect,
               expected);
  const FusedReconstruction fused(buffer, Upsampling::edges);
  std::vector<glm::vec4> padded;
  for (const glm::vec3& v : values) padded.emplace_back(v, 0.0f);
  const std::vector<glm::vec4> no_direct(fused.direct_values(), glm::vec4(0.0f));
  expect_equal(fused.resolve(no_direct, padded, log).indirect, expected);
}

// Red if light of the bright wall leaks onto the black panel: a bilinear lookup gives the panel's last column
// up to a half of it. Here every sub-sample takes its own side, so the edge pixel holds exactly its share of
// wall.
TEST(Reconstruction, DoesNotLeakAcrossADepthEdge) {
  const DeepFrameBuffer buffer = depth_edge(10, 6);
  std::vector<glm::vec3> indirect;
  for (const SurfaceSample& s : buffer.indirect) indirect.emplace_back(s.position.z < 0.0f ? 1.0f : 0.0f);
  const Image image = reconstruct_indirect_cpu(buffer, closest_view_samples(buffer), indirect);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 10; ++x) {
      // Sub-samples of pixel 4 lie at 4.25 (panel) and 4.75 (wall).
      EXPECT_EQ(image.at(x, y).x, x < 4 ? 0.0f : x == 4 ? 0.5f : 1.0f) << x << ' ' << y;
    }
  }
}

// Red if normals are ignored: along a crease the nearest point may lie on the other wall.
TEST(Reconstruction, DoesNotLeakAcrossACrease) {
  const DeepFrameBuffer buffer = buffer_of(10, 4, [](float x, float y) {
    const float from_crease = (x - 4.6f) * 0.1f;
    return from_crease < 0.0f ? sample_at({0, -y * 0.1f, -from_crease}, {1, 0, 0})
                              : sample_at({from_crease, -y * 0.1f, 0}, {0, 0, 1});
  });
  const std::vector<uint32_t> closest = closest_view_samples(buffer);
  for (size_t i = 0; i < closest.size(); ++i) {
    EXPECT_EQ(buffer.indirect[closest[i]].shading_normal, buffer.direct[i].shading_normal) << i;
  }
}

// Red if a sub-sample takes a pixel outside its 3x3 neighbourhood, e.g. from the other end of the previous
// row.
TEST(Reconstruction, TakesOnlyPixelsAroundTheSubsample) {
  const DeepFrameBuffer buffer = depth_edge(9, 7);
  const std::vector<uint32_t> closest = closest_view_samples(buffer);
  for (int y = 0; y < 14; ++y) {
    for (int x = 0; x < 18; ++x) {
      const auto pixel = static_cast<int>(closest[static_cast<size_t>(y * 18 + x)]);
      EXPECT_LE(std::abs(pixel % 9 - x / 2), 1);
      EXPECT_LE(std::abs(pixel / 9 - y / 2), 1);
    }
  }
}

// Red if a miss takes a surface's light, or a hit takes a miss's.
TEST(Reconstruction, MissesTakeNothingAndGiveNothing) {
  const DeepFrameBuffer buffer = buffer_of(8, 4, [](float x, float y) {
    return x < 3.6f ? sample_at({x * 0.1f, -y * 0.1f, 0}, {0, 0, 1}) : SurfaceSample{};
  });
  const std::vector<uint32_t> closest = closest_view_samples(buffer);
  for (size_t i = 0; i < closest.size(); ++i) {
    ASSERT_EQ(closest[i] == nothing, !buffer.direct[i].valid) << i;
    EXPECT_TRUE(closest[i] == nothing || buffer.indirect[closest[i]].valid) << i;
  }
  std::vector<glm::vec3> indirect(buffer.indirect.size(), glm::vec3(1.0f));
  const Image image = reconstruct_indirect_cpu(buffer, closest, indirect);
  EXPECT_EQ(image.at(2, 1), glm::vec3(1.0f));
  EXPECT_EQ(image.at(3, 1), glm::vec3(0.5f));
  EXPECT_EQ(image.at(4, 1), glm::vec3(0.0f));
}

// Red if a thin thing that no pixel centre hits makes an index out of nothing.
TEST(Reconstruction, SubsamplesWithoutAnyViewSampleAroundTakeNothing) {
  const DeepFrameBuffer buffer = buffer_of(7, 7, [](float x, float y) {
    return x > 3.0f && x < 3.3f && y > 3.0f && y < 3.3f ? sample_at({0, 0, 0}, {0, 0, 1}) : SurfaceSample{};
  });
  for (const uint32_t index : closest_view_samples(buffer)) EXPECT_EQ(index, nothing);
}

// Red if the choice depends on the unit of length.
TEST(Reconstruction, ChoosesTheSameAtAnyScale) {
  const Scene scene = test::room_scene();
  const RayTracer tracer(scene);
  View view;
  view.camera.eye = {0.2f, 0.3f, 1.9f};
  view.width = 40, view.height = 30;
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, view);
  const std::vector<uint32_t> before = closest_view_samples(buffer);
  buffer.view.camera.eye *= 1024.0f;
  for (std::vector<SurfaceSample>* set : {&buffer.indirect, &buffer.direct}) {
    for (SurfaceSample& s : *set) s.position *= 1024.0f;
  }
  EXPECT_EQ(closest_view_samples(buffer), before);
}

// Red if a NaN passes into the image, or vanishes without a word.
TEST(Reconstruction, NonFinitePixelsAreReplacedAndReported) {
  const auto context = gpu::Context::create("osmesa");
  const DeepFrameBuffer buffer = depth_edge(10, 6);
  auto direct = random_values(buffer.direct.size(), 1);
  const auto indirect = random_values(buffer.indirect.size(), 2);
  direct[2 * 20 + 6].y = std::numeric_limits<float>::quiet_NaN();  // pixel (3, 1)
  const Reconstruction reconstruction(buffer);
  StageLog log;
#ifdef NDEBUG
  const auto images = reconstruction.resolve(on_gpu(direct), on_gpu(indirect), log);
  EXPECT_EQ(images.direct.at(3, 1), glm::vec3(0.0f));
  EXPECT_EQ(log.counters().at("non_finite_reconstruction"), 1);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_NE(log.warnings()[0].find("x = 3, y = 1"), std::string::npos) << log.warnings()[0];
#else
  EXPECT_THROW(reconstruction.resolve(on_gpu(direct), on_gpu(indirect), log), Error);
#endif
}

}  // namespace
}  // namespace relight
