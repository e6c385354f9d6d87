#include "experiments/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include <tbb/parallel_for.h>

#include "experiments/options/parse.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"
#include "reference/path_tracer.h"

namespace relight {

namespace {

// `cpu`: of all threads of the process; on a machine shared with others it drifts less than `wall`, but it
// does not count threads that wait for the last one.
struct Seconds {
  double wall = 0.0, cpu = 0.0;
};

template <typename Function>
Seconds seconds_of(Function function) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  function();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The spread of ratios that single repeats would have given.
std::string spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.2f} .. {:.2f}", *low, *high);
}

PathTracerSettings settings_of(const BenchOptions& options) {
  const BounceRange bounces = parse_bounces(options.bounces, 0);
  if (options.samples < 1 || options.samples > 64)
    usage_fail("--samples {}: expected 1 to 64 (all rays are kept in memory)", options.samples);
  if (options.repeats < 1 || options.repeats > 1000)
    usage_fail("--repeats {}: expected 1 to 1000", options.repeats);
  PathTracerSettings settings;
  settings.paths = {bounces.min, bounces.max, true, true, true, true};
  settings.estimator = parse_estimator(options.estimator);
  settings.samples_per_pixel = std::max(2, options.samples);
  settings.batches = 2;
  settings.seed = options.session.seed;
  return settings;
}

struct Measured {
  RayCounts rays;
  std::vector<double> whole, raw, share, cpu_share;
};

Measured measure(Session& session, const PathTracerSettings& settings, int repeats) {
  Progress quiet(true);
  StageLog log;
  const auto render = [&] {
    path_trace(session.tracer(), session.buffer(), session.lighting(), settings, quiet, log);
  };
  RayLog rays;
  session.tracer().set_log(&rays);
  render();
  session.tracer().set_log(nullptr);

  std::vector<const RayLog::Thread*> threads;
  for (const RayLog::Thread& thread : rays.threads) threads.push_back(&thread);
  std::vector<RayCounts> counts(threads.size());
  const auto replay = [&] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, threads.size(), 1),
        [&](const auto& range) {
          for (size_t i = range.begin(); i < range.end(); ++i)
            counts[i] = session.tracer().replay(*threads[i]);
        },
        tbb::simple_partitioner());
  };
  Measured measured;
  for (int i = 0; i < repeats; ++i) {
    const Seconds whole = seconds_of(render), raw = seconds_of(replay);
    measured.whole.push_back(whole.wall);
    measured.raw.push_back(raw.wall);
    measured.share.push_back(raw.wall / whole.wall);
    measured.cpu_share.push_back(raw.cpu / whole.cpu);
  }
  for (const RayCounts& c : counts) {
    measured.rays.nearest += c.nearest;
    measured.rays.occlusion += c.occlusion;
    measured.rays.in_packets += c.in_packets;
  }
  return measured;
}

}  // namespace

std::string run_bench(const BenchOptions& options) {
  const PathTracerSettings settings = settings_of(options);
  Session session(options.session, Session::Gpu::not_needed);
  const Measured m = measure(session, settings, options.repeats);
  const double total = 1e-6 * static_cast<double>(m.rays.total());
  const auto million = [](int64_t n) { return 1e-6 * static_cast<double>(n); };
  return fmt::format(
      "{} triangles, {} paths a pixel, {}, {}\n"
      "rays                      {:8.2f} M: {:.2f} nearest hit, {:.2f} occlusion one by one, {:.2f} in "
      "packets of 16\n"
      "path tracer, whole        {:8.2f} Mrays/s  (median of {}; direct light, shading and statistics "
      "included)\n"
      "Embree alone, same rays   {:8.2f} Mrays/s\n"
      "share of Embree alone     {:8.2f}          ({})\n"
      "the same in CPU time      {:8.2f}          ({}; steadier where others use the machine)\n",
      session.scene().triangles.size(), settings.samples_per_pixel, settings.paths.to_string(),
      to_string(settings.estimator), total, million(m.rays.nearest), million(m.rays.occlusion),
      million(m.rays.in_packets), total / median(m.whole), options.repeats, total / median(m.raw),
      median(m.share), spread(m.share), median(m.cpu_share), spread(m.cpu_share));
}

}  // namespace relight
