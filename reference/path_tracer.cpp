#include "reference/path_tracer.h"

#include <algorithm>
#include <chrono>

#include "common/run/error.h"
#include "reference/batch_renderer.h"
#include "reference/direct_image.h"

namespace relight {

namespace {

// A sixteenth of the samples at most, and enough: a tile has 16 pixels.
constexpr int planning_samples = 8, least_samples_for_planning = 128;

void check(const PathTracerSettings& settings, const DeepFrameBuffer& buffer) {
  const int least = settings.one_sequence ? 1 : 2;
  if (settings.batches < least)
    fail("path tracer: batches = {}; it must be at least {}", settings.batches, least);
  if (settings.samples_per_pixel < settings.batches)
    fail("path tracer: samples_per_pixel = {}; it must be at least the number of batches ({})",
         settings.samples_per_pixel, settings.batches);
  const LightPaths& paths = settings.paths;
  if (paths.min_bounces < 0 || paths.max_bounces < paths.min_bounces)
    fail("path tracer: bounces {}..{}; needed are 0 <= min <= max", paths.min_bounces, paths.max_bounces);
  if (!(settings.time_limit_s >= 0.0))
    fail("path tracer: time_limit_s = {}; it must be >= 0 (0: no limit)", settings.time_limit_s);
  const size_t pixels = static_cast<size_t>(buffer.view.width) * static_cast<size_t>(buffer.view.height);
  if (buffer.indirect.size() != pixels || buffer.direct.size() != 4 * pixels)
    fail("path tracer: the deep frame buffer does not hold {}x{} pixels", buffer.view.width,
         buffer.view.height);
}

void write_images(const std::vector<PixelStatistics>& pixels, const View& view, int batches,
                  PathTracerResult& result) {
  result.indirect = Image(view.width, view.height);
  for (size_t i = 0; i < pixels.size(); ++i) result.indirect.pixels[i] = glm::vec3(pixels[i].mean);
  if (batches < 2) return;
  result.indirect_variance = Image(view.width, view.height);
  const double n = static_cast<double>(batches);
  for (size_t i = 0; i < pixels.size(); ++i)
    result.indirect_variance.pixels[i] = glm::vec3(pixels[i].squares / (n * (n - 1.0)));
}

}  // namespace

PathTracerResult path_trace(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                            const LightingState& lighting, const PathTracerSettings& settings,
                            Progress& progress, StageLog& log) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  check(settings, buffer);
  const LightSampler lights(lighting);
  PathTracerResult result;
  {
    StageTimer timer(log, "direct");
    DirectImage direct = trace_direct(tracer, buffer, lights, settings.paths);
    result.direct = std::move(direct.image);
    result.rays = direct.rays, result.non_finite = direct.non_finite;
  }

  StageTimer timer(log, "indirect");
  const int per_batch = (settings.samples_per_pixel + settings.batches - 1) / settings.batches;
  const int least_batches = settings.one_sequence ? 1 : 2;
  const PathSampler sampler(tracer, lights, settings.paths, settings.estimator);
  BatchRenderer renderer(sampler, tracer, buffer, settings, per_batch);
  progress.start("path tracing", static_cast<int64_t>(settings.batches) * renderer.tasks());
  const bool adaptive = settings.estimator == Estimator::light_vertex && !settings.one_sequence;
  if (adaptive && settings.samples_per_pixel >= least_samples_for_planning) renderer.plan(planning_samples);
  double longest_batch = 0.0;
  for (int batch = 0; batch < settings.batches; ++batch) {
    const double before = elapsed();
    const bool too_late = settings.time_limit_s > 0.0 && before + longest_batch > settings.time_limit_s;
    if (batch >= least_batches && too_late) break;
    renderer.render(batch, progress);
    longest_batch = std::max(longest_batch, elapsed() - before);
    result.batches = batch + 1;
  }
  progress.finish();
  result.samples_per_pixel = result.batches * per_batch;
  result.rays += renderer.rays();
  result.non_finite += renderer.non_finite();
  // Batches of one sequence aren't independent: their spread says nothing about the error.
  write_images(renderer.pixels(), buffer.view, settings.one_sequence ? 1 : result.batches, result);
  log.count("rays", result.rays);
  log.count("non_finite_samples", result.non_finite);
  if (result.non_finite > 0)
    log.warn(fmt::format("{} non-finite path samples were replaced by zero", result.non_finite));
  return result;
}

}  // namespace relight
