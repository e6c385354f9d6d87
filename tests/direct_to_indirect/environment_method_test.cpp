// Light of the environment through the method's interface: the devices against each other, no cost without an
// environment, what is kept between relights, and the path tracer restricted to the same paths.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/image/metrics.h"
#include "reference/path_tracer.h"
#include "tests/reference/skies.h"
#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

using test::relative_difference;
using test::TransferBench;

const Light lamp = tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(2.0f, 1.5f, 1.0f));

// The room is open towards the camera, and light from there falls in.
Scene room(const Environment& environment, bool glossy = false) {
  Scene scene = tiny::room(2.0f, glm::vec3(0.0f), glossy);
  scene.environment = environment;
  finish_scene(scene);
  return scene;
}

Environment constant(const glm::vec3& radiance) {
  Environment environment;
  environment.radiance = radiance;
  return environment;
}

Relit relit(TransferBench& bench, TransferBench::Knobs knobs, StageLog& log,
            const LightingState& lighting = tiny::lighting({lamp})) {
  knobs.insert(knobs.begin(), {{"shadows", "traced"}, {"environment_samples", "1024"}});
  return bench.prepare(knobs)->relight(lighting, log);
}
Relit relit(TransferBench& bench, const TransferBench::Knobs& knobs) {
  StageLog log;
  return relit(bench, knobs, log);
}

// 200 float roundings of 2^-24, as for gloss. The oracle has just computed the matrices, the others take them
// from the cache. Not tried yet, each should be red: environment left out of the gather samples' light on the
// CPU; the glossy product left out on the GPU; the matrices' order exchanged in the cached bytes.
TEST(EnvironmentMethod, EveryDeviceAgreesWithTheDoublePrecisionOracle) {
  for (const bool glossy : {false, true}) {
    TransferBench bench(room(tiny::uneven_map(32, 16, 0.4f), glossy));
    const Relit oracle = relit(bench, {{"device", "oracle"}});
    EXPECT_EQ(bench.precompute_log.counters().count("cache_hits"), 0u);
    for (const auto& [device, product] : {std::pair{"gpu", "tiles"}, {"gpu", "rows"}, {"cpu", "tiles"}}) {
      StageLog log;
      const Relit found =
          relit(bench, {{"device", device}, {"product", product}, {"weights", "float32"}}, log);
      EXPECT_EQ(bench.precompute_log.counters().at("cache_hits"), 1);
      EXPECT_LT(relative_difference(found.direct, oracle.direct), 1.2e-5) << device << " " << product;
      EXPECT_LT(relative_difference(found.indirect, oracle.indirect), 1.2e-5) << device << " " << product;
      EXPECT_EQ(log.stages().front().first, "environment");
      EXPECT_TRUE(log.warnings().empty());
    }
  }
}

int mentions_of_environment(const StageLog& log) {
  const auto mentions = [](const std::string& name) { return name.find("environment") != std::string::npos; };
  int found = 0;
  for (const auto& [name, seconds] : log.stages()) found += mentions(name);
  for (const auto& [name, count] : log.counters()) found += mentions(name);
  for (const auto& [name, bytes] : log.bytes()) found += mentions(name);
  return found;
}

// Red if a scene without an environment pays for one in rays, bytes, stages or counters, or its picture
// changes by a bit. (That the cached bytes are as before is seen where both are: tests/run.)
TEST(EnvironmentMethod, CostsNothingWhereThereIsNone) {
  TransferBench dark(room({}));
  ArtefactCache dark_clouds = ArtefactCache::in_memory();
  dark.parts = &dark_clouds;
  StageLog log;
  const Relit automatic = relit(dark, {{"device", "gpu"}}, log);
  EXPECT_EQ(mentions_of_environment(dark.precompute_log) + mentions_of_environment(log), 0);
  StageLog off_log;
  const Relit off = relit(dark, {{"device", "gpu"}, {"environment", "off"}}, off_log);
  EXPECT_EQ(relative_difference(automatic.total, off.total), 0.0);
  // Off although there is one: the same again, and the light paths say so.
  TransferBench lit(room(constant(glm::vec3(1.0f))));  // its GPU context is the current one from here on
  const Relit left_out = relit(lit, {{"device", "gpu"}, {"environment", "off"}}, log);
  EXPECT_EQ(mentions_of_environment(lit.precompute_log) + mentions_of_environment(log), 0);
  EXPECT_EQ(relative_difference(left_out.total, off.total), 0.0);
  KnobValues knobs(lit.method->knobs());
  EXPECT_TRUE(lit.method->light_paths(knobs).environment);
  EXPECT_EQ(lit.method->light_paths(knobs).last_environment_bounce(), 1);
  knobs.set("environment", "off");
  EXPECT_FALSE(lit.method->light_paths(knobs).environment);
  // On although there is none: prepared for, and then used by a lighting that brings one.
  const Relit on = relit(dark, {{"device", "cpu"}, {"environment", "on"}}, log);
  EXPECT_GT(dark.precompute_log.counters().at("environment_rays"), 0);
  EXPECT_LT(relative_difference(on.total, off.total), 0.02) << "the CPU traces the same shadows";
}

// A lighting that brings light from an environment that nothing was computed for is refused, unless it is
// known from the start, or asked for.
TEST(EnvironmentMethod, RefusesAnEnvironmentThatComesTooLate) {
  TransferBench bench(room({}), 16, 12);
  ArtefactCache clouds = ArtefactCache::in_memory();
  bench.parts = &clouds;
  LightingState daylight = tiny::lighting({lamp});
  daylight.environment = std::make_shared<const Environment>(constant(glm::vec3(0.5f)));
  StageLog log;
  try {
    relit(bench, {{"device", "cpu"}}, log, daylight);
    FAIL() << "no error";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("direct_to_indirect.environment"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("valid here: on, off"), std::string::npos);
  }
  const Relit asked = relit(bench, {{"device", "cpu"}, {"environment", "on"}}, log, daylight);
  bench.lighting = &daylight;
  const Relit known = relit(bench, {{"device", "cpu"}}, log, daylight);
  EXPECT_EQ(relative_difference(asked.total, known.total), 0.0);
  EXPECT_GT(test::norm(known.direct), 0.0);
}

// The environment's light is kept while lamps move, computed again when it turns, and after forget(). Red if
// what is kept is the environment's address (tried: the comparison of texels left out).
TEST(EnvironmentMethod, KeepsItsLightWhileItStandsStill) {
  for (const char* device : {"cpu", "gpu"}) {
    TransferBench bench(room(tiny::uneven_map(16, 8, 0.0f)), 24, 18);
    const auto prepared =
        bench.prepare({{"device", device}, {"shadows", "traced"}, {"environment_samples", "256"}});
    const auto updates = [&](const LightingState& lighting) {
      StageLog log;
      prepared->relight(lighting, log);
      return log.counters().count("environment_updates");
    };
    Light moved = lamp;
    moved.position.x += 0.1f;
    LightingState other = tiny::lighting({lamp});
    Environment changed = bench.scene.environment;
    changed.texels[5] += glm::vec3(1.0f);
    other.environment = std::make_shared<const Environment>(changed);
    EXPECT_EQ(updates(tiny::lighting({lamp})), 1u);
    EXPECT_EQ(updates(tiny::lighting({moved})), 0u);
    EXPECT_EQ(updates(other), 1u);
    EXPECT_EQ(updates(other), 0u);
    prepared->forget();
    EXPECT_EQ(updates(other), 1u);
    StageLog log;
    LightingState night = tiny::lighting({lamp});
    night.environment = std::make_shared<const Environment>();
    const Relit dark = prepared->relight(night, log);
    EXPECT_EQ(mentions_of_environment(log), 0);
    const Relit lit = prepared->relight(other, log);
    EXPECT_GT(test::norm(lit.total), test::norm(dark.total));
  }
}

PathTracerResult trace(const TransferBench& bench, const LightPaths& paths, int samples) {
  PathTracerSettings settings;
  settings.paths = paths;
  settings.samples_per_pixel = samples;
  Progress quiet(true);
  StageLog log;
  return path_trace(bench.tracer, bench.buffer, tiny::lighting({}), settings, quiet, log);
}

double mean(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += static_cast<double>(p.x + p.y + p.z);
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

// Light of the environment alone, one bounce, against the path tracer: means over the picture, in which noise
// and truncation average out, and the picture itself. Constant: nothing is truncated. Map: rows keep 200 of
// 1024 coefficients. The reference's noise is 0.3 % of a picture at 64 x 4 points and 1,024 paths. One bounce
// is too dark by 1.4, 0.9 and 0.7 % in the mean of 12 seeds (spread 0.3 %), by 0.9, 0.5 and 0.5 % with 16,384
// gather samples, whatever the links and the near field: hence 2 %. Tried, each red: the gather samples'
// light left out; their albedo left out; the environment seen twice by the camera; environment_bounces 0.
TEST(EnvironmentMethod, AgreesWithThePathTracerForOneBounce) {
  struct Case {
    Environment environment;
    bool glossy;
    double bound;  // of the picture
  };
  for (const Case& c : {Case{constant({1.0f, 0.8f, 0.6f}), false, 0.02},
                        {tiny::uneven_map(16, 8, 0.3f), false, 0.05},
                        {tiny::uneven_map(16, 8, 0.3f), true, 0.05}}) {
    TransferBench bench(room(c.environment, c.glossy));
    StageLog log;
    const Relit found = relit(bench,
                              {{"device", "cpu"},
                               {"weights", "float32"},
                               {"gather_samples", "4096"},
                               {"link_threshold", "0.1"},
                               {"environment_coefficients", "200"},
                               {"environment_gather_coefficients", "100"},
                               {"near_field", "hemisphere"}},
                              log, tiny::lighting({}));
    const PathTracerResult truth =
        trace(bench, bench.method->light_paths(KnobValues(bench.method->knobs())), 1024);
    EXPECT_NEAR(mean(found.direct), mean(truth.direct), 0.005 * mean(truth.direct));
    EXPECT_NEAR(mean(found.indirect), mean(truth.indirect), 0.02 * mean(truth.indirect));
    // Without edges, where light is upsampled; unclamped by a small exposure. The reference's own noise
    // counts.
    const ErrorReport error =
        compare_images(found.total, truth.total(), truth.indirect_variance, bench.buffer.edge, 1e-3f);
    EXPECT_LT(error.value.relative_edges_out, std::hypot(c.bound, error.noise_floor.relative_edges_out));
    EXPECT_LT(error.noise_floor.relative_edges_out, c.bound) << "too noisy to tell";
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
