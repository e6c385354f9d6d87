#include <chrono>
#include <filesystem>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "reference/path_tracing_method.h"
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

const LightingState one_light = lighting({omni({0.3f, 0.6f, 0.4f})});

struct Prepared_ {
  Rendering render{room(), 32, 24};
  std::unique_ptr<Method> method = make_path_tracing();
  KnobValues knobs{method->knobs()};
  std::unique_ptr<gpu::Context> gpu = gpu::Context::create("osmesa");
  ArtefactCache cache{std::filesystem::temp_directory_path(), false};
  Progress progress{true};
  StageLog log;
  Relit relight(StageLog& relight_log) {
    const PrepareContext context{render.scene, render.tracer, render.buffer, knobs, 1,
                                 *gpu,         cache,         progress,      log};
    return method->prepare(context)->relight(one_light, relight_log);
  }
};

// Red if (both tried): the method counts other paths than its declared ones, or a reference with the same
// seed shares its noise (equal images would make the method look perfect).
TEST(PathTracingMethod, ConvergesToTheReferenceWithItsOwnNoise) {
  Prepared_ p;
  p.knobs.set("samples", "256");
  p.knobs.set("bounces_max", "2");
  StageLog log;
  const Relit relit = p.relight(log);
  const LightPaths paths = p.method->light_paths(p.knobs);
  EXPECT_EQ(paths.max_bounces, 2);
  const PathTracerResult reference = p.render(one_light, settings(Estimator::next_event, 256, 16, paths, 1));
  const double pixels = static_cast<double>(reference.indirect.pixels.size());
  const double error = std::sqrt(2.0 * mean_of(reference.indirect_variance).x / pixels);
  const double difference = mean_of(relit.indirect).x - mean_of(reference.indirect).x;
  EXPECT_LT(std::abs(difference), 5.0 * error);
  // The same samples from the same seed without a seed of the method's own would be the same picture.
  PathTracerSettings twin = settings(Estimator::next_event, 256, 1, paths, 1);
  twin.one_sequence = true;
  EXPECT_NE(mean_of(p.render(one_light, twin).indirect), mean_of(relit.indirect));
  EXPECT_EQ(mean_of(relit.direct), mean_of(reference.direct));
  EXPECT_EQ(log.counters().at("samples_per_pixel"), 256);
}

// Red if (both tried): the budget is ten times too long, or a hundred times too short.
TEST(PathTracingMethod, SpendsItsTimeBudget) {
  Prepared_ p;
  p.knobs.set("time_ms", "300");
  StageLog log;
  const auto start = std::chrono::steady_clock::now();
  p.relight(log);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.5);
  EXPECT_GT(log.counters().at("samples_per_pixel"), 4);
  EXPECT_GT(log.total_seconds(), 0.15);
}

}  // namespace
}  // namespace relight::tiny
