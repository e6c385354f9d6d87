// The whole method through its interface: GPU against its CPU twin, linearity, and the cache.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "methods/direct_to_indirect/artefact.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "tests/direct_to_indirect/gather_setup.h"
#include "tests/support/image_difference.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;

// Runs the method on the tiny room; 60x45 view, 1024 gather samples.
struct Bench {
  Scene scene = tiny::room();
  RayTracer tracer{scene};
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 60, 45});
  std::unique_ptr<gpu::Context> context;
  std::unique_ptr<Method> method = make_direct_to_indirect();
  ArtefactCache cache;
  StageLog log;

  explicit Bench(const std::string& gpu = "osmesa", const std::filesystem::path& cache_folder = {})
      : context(gpu::Context::create(gpu)), cache(cache_folder, !cache_folder.empty()) {}

  Relit relit(const LightingState& lighting, const std::vector<std::pair<std::string, std::string>>& knobs) {
    KnobValues values(method->knobs());
    values.set("gather_samples", "1024");
    for (const auto& [name, value] : knobs) values.set(name, value);
    Progress progress(true);
    log = {};
    StageLog relight_log;
    const PrepareContext prepare{scene, tracer, buffer, values, 1, *context, cache, progress, log};
    return method->prepare(prepare)->relight(lighting, relight_log);
  }
};

const Light lamp = tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(2.0f, 1.5f, 1.0f));
const Light beam = tiny::spot({-0.4f, 0.9f, 0.5f}, {0.2f, -1.0f, -0.1f}, 15.0f, 20.0f, glm::vec3(3.0f));

// The products sum about 100 products and 5 Haar levels in float, the oracle in double: they differ by
// rounding only. The bound is 100 roundings of 2^-24. Red if GLSL and C++ read different coefficients, rows
// or albedos.
TEST(Transfer, EveryProductAgreesWithTheDoublePrecisionOracle) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "relight_products_test";
  std::filesystem::remove_all(folder);
  Bench bench("osmesa", folder);  // one precompute for all
  const LightingState lighting = tiny::lighting({beam});
  const Relit oracle = bench.relit(lighting, {{"device", "oracle"}, {"shadows", "traced"}});
  for (const auto& [device, product] :
       {std::pair{"gpu", "rows"}, {"gpu", "tiles"}, {"gpu", "quads"}, {"cpu", "rows"}, {"cpu", "tiles"}}) {
    const Relit relit = bench.relit(
        lighting, {{"device", device}, {"product", product}, {"weights", "float32"}, {"shadows", "traced"}});
    EXPECT_LT(relative_difference(relit.indirect, oracle.indirect), 6e-6) << device << " " << product;
  }
  std::filesystem::remove_all(folder);
}

// Red if state of one relight leaks into the next, or a light is counted twice.
TEST(Transfer, IsLinearInTheLights) {
  Bench bench;
  const std::vector<std::pair<std::string, std::string>> traced = {{"shadows", "traced"}};
  const Relit a = bench.relit(tiny::lighting({lamp}), traced),
              b = bench.relit(tiny::lighting({beam}), traced);
  const Relit both = bench.relit(tiny::lighting({lamp, beam}), traced);
  Image sum = a.indirect;
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += b.indirect.pixels[i];
  EXPECT_LT(relative_difference(both.indirect, sum), 1e-5);
}

// Mesa's two back ends run the same llvmpipe, but other drivers need not: the bound is that of the CPU twin,
// for traced shadows (rasterised shadow maps may differ by a texel).
TEST(Transfer, OsmesaAndEglAgree) {
  Bench osmesa;
  const std::vector<std::pair<std::string, std::string>> traced = {{"shadows", "traced"}};
  const Relit a = osmesa.relit(tiny::lighting({lamp}), traced);
  std::unique_ptr<Bench> egl;
  try {
    egl = std::make_unique<Bench>("egl");
  } catch (const std::exception& error) {
    GTEST_SKIP() << "no EGL context on this machine: " << error.what();
  }
  const Relit b = egl->relit(tiny::lighting({lamp}), traced);
  EXPECT_LT(relative_difference(a.indirect, b.indirect), 6e-6);
  EXPECT_LT(relative_difference(a.total, b.total), 6e-6);
}

TEST(Transfer, IsBlackWithoutLight) {
  Bench bench;
  for (const glm::vec3& p : bench.relit(tiny::lighting({}), {}).total.pixels) ASSERT_EQ(p, glm::vec3(0.0f));
}

// Red if the key forgets a precompute knob (then the second run would hit), or the bytes lose something.
TEST(Transfer, CacheGivesTheSamePictureAndKnowsTheKnobs) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "relight_transfer_cache_test";
  std::filesystem::remove_all(folder);
  Bench bench("osmesa", folder);
  const LightingState lighting = tiny::lighting({lamp});
  const Relit first = bench.relit(lighting, {});
  EXPECT_EQ(bench.log.counters().count("cache_hits"), 0u);
  const Relit second = bench.relit(lighting, {});
  EXPECT_EQ(bench.log.counters().count("cache_hits"), 1u);
  EXPECT_EQ(relative_difference(first.total, second.total), 0.0);
  bench.relit(lighting, {{"hierarchy_k", "30"}});
  EXPECT_EQ(bench.log.counters().count("cache_hits"), 0u);
  bench.relit(lighting, {{"shadow_map_size", "512"}});
  EXPECT_EQ(bench.log.counters().count("cache_hits"), 1u) << "a relight knob must not cost a precompute";
  std::filesystem::remove_all(folder);
}

// A value in range that is not the default.
std::string other_value(const Knob& knob) {
  if (knob.type == KnobType::choice)
    return knob.choices.back() == knob.default_value ? knob.choices.front() : knob.choices.back();
  const double value = std::stod(knob.default_value);
  const double other = 0.5 * (value + (value < knob.max ? knob.max : knob.min));
  return knob.type == KnobType::integer ? std::to_string(static_cast<int64_t>(other)) : std::to_string(other);
}

// Red if a knob is declared to act on relighting only although the precompute reads it, or is left out of the
// key.
TEST(Transfer, CacheKeyKnowsEveryPrecomputeKnobAndNoOther) {
  Bench bench;
  const auto key = [&](const KnobValues& values) {
    Progress progress(true);
    return cache_key({bench.scene, bench.tracer, bench.buffer, values, 1, *bench.context, bench.cache,
                      progress, bench.log});
  };
  const KnobTable table = bench.method->knobs();
  const std::string usual = key(KnobValues(table));
  for (const Knob& knob : table) {
    if (knob.type == KnobType::boolean || other_value(knob) == knob.default_value) continue;
    KnobValues values(table);
    values.set(knob.name, other_value(knob));
    EXPECT_EQ(key(values) == usual, knob.phase == KnobPhase::relight) << knob.name;
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
