#include "experiments/bench/bench.h"

#include <algorithm>
#include <vector>

#include "experiments/bench/replay.h"
#include "experiments/bench/timing.h"
#include "experiments/options/parse.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"
#include "reference/path_tracer.h"

namespace relight {

namespace {

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

  Replay replay(session.tracer(), rays);
  Measured measured;
  for (int i = 0; i < repeats; ++i) {
    const Seconds whole = seconds_of(render), raw = seconds_of([&] { replay.run(); });
    measured.whole.push_back(whole.wall);
    measured.raw.push_back(raw.wall);
    measured.share.push_back(raw.wall / whole.wall);
    measured.cpu_share.push_back(raw.cpu / whole.cpu);
  }
  measured.rays = replay.counts();
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
