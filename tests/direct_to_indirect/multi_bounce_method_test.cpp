// Several bounces through the method's interface: GPU against its twin, declared light paths, no work with
// one bounce, the cache, and the path tracer of a bounce more.
#include <cmath>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/multi_bounce_light.h"
#include "tests/direct_to_indirect/multi_bounce_setup.h"
#include "tests/support/image_difference.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;

using Settings = std::vector<std::pair<std::string, std::string>>;

// Runs the method on the tiny room; 48x36 view, 1024 gather samples.
struct Bench {
  Scene scene = tiny::room();
  RayTracer tracer{scene};
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 48, 36});
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  std::unique_ptr<Method> method = make_direct_to_indirect();
  ArtefactCache cache;
  StageLog precompute_log, relight_log;

  explicit Bench(const std::filesystem::path& cache_folder = {})
      : cache(cache_folder, !cache_folder.empty()) {}

  KnobValues knobs(const Settings& settings) const {
    KnobValues values(method->knobs());
    for (const auto& [name, value] : Settings{{"gather_samples", "1024"},
                                              {"photons", "50000"},
                                              {"photon_neighbours", "300"},
                                              {"shadows", "traced"}})
      values.set(name, value);
    for (const auto& [name, value] : settings) values.set(name, value);
    return values;
  }

  Relit relit(const Settings& settings) {
    const KnobValues values = knobs(settings);
    Progress progress(true);
    precompute_log = {}, relight_log = {};
    const PrepareContext prepare{scene, tracer, buffer, values, 1, *context, cache, progress, precompute_log};
    return method->prepare(prepare)->relight(
        tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f}, {2.0f, 1.5f, 1.0f})}), relight_log);
  }
};

double sum(const Image& image) {
  double total = 0.0;
  for (const glm::vec3& p : image.pixels) total += static_cast<double>(p.x + p.y + p.z);
  return total;
}

// What the reference is restricted to. Tried: the default light paths.
TEST(MultiBounceMethod, DeclaresAsManyDiffuseBouncesAsItComputes) {
  const Bench bench;
  for (const int bounces : {1, 4}) {
    const LightPaths paths = bench.method->light_paths(bench.knobs({{"bounces", std::to_string(bounces)}}));
    EXPECT_EQ(paths.min_bounces, 1);
    EXPECT_EQ(paths.max_bounces, bounces);
    EXPECT_FALSE(paths.glossy_interior || paths.emission);
  }
}

int mentions_of_bounces(const StageLog& log) {
  const auto mentions = [](const std::string& name) {
    return name.find("bounce") != std::string::npos || name.find("photon") != std::string::npos;
  };
  int found = 0;
  for (const auto& [name, seconds] : log.stages()) found += mentions(name);
  for (const auto& [name, count] : log.counters()) found += mentions(name);
  for (const auto& [name, bytes] : log.bytes()) found += mentions(name);
  return found;
}

// Red if a scene that asks for one bounce pays for more in rays, bytes, stages or counters; if bounces do not
// reach the picture or the kinds disagree about how much light they are; if the cache's bytes lose some of a
// matrix.
TEST(MultiBounceMethod, AddsLightByEitherKindFromTheCacheTooAndOneBounceCostsNothing) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "relight_bounce_cache_test";
  std::filesystem::remove_all(folder);
  Bench bench(folder);
  const double one = sum(bench.relit({{"bounces", "1"}}).indirect);
  EXPECT_EQ(mentions_of_bounces(bench.precompute_log) + mentions_of_bounces(bench.relight_log), 0);
  std::map<std::string, double> light;
  for (const std::string kind : {"photons", "transfer"}) {
    const Settings settings = {{"bounces", "4"}, {"multi_bounce", kind}};
    const Relit first = bench.relit(settings);
    EXPECT_GE(mentions_of_bounces(bench.precompute_log), 7) << kind;
    EXPECT_EQ(mentions_of_bounces(bench.relight_log), 1) << kind;
    const int64_t beyond = bench.precompute_log.counters().at("bounce_energy_beyond_ppm");
    EXPECT_GT(beyond, 0);
    const Relit second = bench.relit(settings);
    EXPECT_EQ(bench.precompute_log.counters().count("cache_hits"), 1u);
    EXPECT_EQ(bench.precompute_log.counters().at("bounce_energy_beyond_ppm"), beyond);
    EXPECT_EQ(relative_difference(first.total, second.total), 0.0);
    light[kind] = sum(first.indirect);
    EXPECT_GT(light[kind], 1.3 * one) << "the room is bright: bounces add half of the first";
  }
  EXPECT_NEAR(light["photons"], light["transfer"], 0.02 * light["transfer"]);
  std::filesystem::remove_all(folder);
}

// Two products of up to 40 terms, or three, and as many Haar transforms in float: rounding only. Red if the
// shader reads another channel, direct light is not added again, or the number of passes differs. Tried,
// together: the addition left out on the GPU; green and blue exchanged in the shader.
TEST(MultiBounceLight, OnTheGpuAgreesWithItsDoublePrecisionTwin) {
  const auto context = gpu::Context::create("osmesa");
  const BounceSetup s(closed_box(glm::vec3(0.8f, 0.5f, 0.2f)), 1024, true);
  std::vector<glm::vec4> direct4(1024);
  std::vector<glm::dvec3> direct(1024);
  for (size_t i = 0; i < 1024; ++i) {
    direct4[i] = glm::vec4(s.cloud.samples[i].position, 0.0f);
    direct[i] = glm::dvec3(s.cloud.samples[i].position);
  }
  const gpu::Buffer direct_buffer = gpu::Buffer::from(direct4);
  const wavelet::HaarGpu haar(1024);
  for (const BounceKind kind : {BounceKind::photons, BounceKind::transfer}) {
    MultiBounceSettings settings = quick_settings(kind, 4);
    settings.photons = 20000;
    const MultiBounceLight light(s.compute(settings), s.cloud, context->max_storage_block_bytes());
    const std::vector<glm::dvec3> twin = light.with_bounces(direct);
    const std::vector<glm::vec4> gpu = light.with_bounces(direct_buffer, haar).download<glm::vec4>();
    double worst = 0.0, norm = 0.0;
    for (size_t i = 0; i < 1024; ++i) {
      worst = std::max(worst, glm::length(glm::dvec3(gpu[i]) - twin[i])),
      norm += glm::length(twin[i]) / 1024.0;
      EXPECT_GT(twin[i].x, direct[i].x);
    }
    EXPECT_LT(worst / norm, 6e-6);
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
