#include "experiments/compare/run_method.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "common/run/error.h"

namespace relight {

namespace {

constexpr int default_repeats = 5;
constexpr double repeat_budget_s = 20.0;  // a slow method (path tracing) must not take six times its time

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void require_size(const Image& image, const char* name, const View& view) {
  if (image.width != view.width || image.height != view.height) {
    fail("the {} image has {}x{} pixels where the view has {}x{}", name, image.width, image.height,
         view.width, view.height);
  }
}

Relit timed_relight(Prepared& prepared, Session& session, StageLog& log, double& seconds) {
  prepared.forget();  // the same lighting again would cost next to nothing
  const auto start = std::chrono::steady_clock::now();
  Relit relit = prepared.relight(session.lighting(), log);
  seconds = seconds_since(start);
  const View& view = session.buffer().view;
  require_size(relit.direct, "direct", view);
  require_size(relit.indirect, "indirect", view);
  require_size(relit.total, "total", view);
  return relit;
}

int number_of_repeats(int wanted, double one_relight_s) {
  if (wanted > 0) return wanted;
  return std::clamp(static_cast<int>(std::min(repeat_budget_s / std::max(one_relight_s, 1e-3), 1e3)), 1,
                    default_repeats);
}

void relight_repeatedly(Prepared& prepared, Session& session, int wanted, MethodRun& run) {
  StageLog warm_up_log;
  double seconds = 0.0;
  run.relit = timed_relight(prepared, session, warm_up_log, seconds);
  const int repeats = number_of_repeats(wanted, seconds);
  std::vector<StageLog> logs(static_cast<size_t>(repeats));
  for (StageLog& log : logs) {
    run.relit = timed_relight(prepared, session, log, seconds);
    run.relight_ms.push_back(1e3 * seconds);
  }
  // The stages shown must add up to the time shown, so they come from one relight: the (lower) median one.
  std::vector<size_t> order(logs.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return run.relight_ms[a] < run.relight_ms[b]; });
  run.relight = logs[order[(order.size() - 1) / 2]];
}

}  // namespace

MethodRun run_method(const MethodPlan& plan, Session& session, int repeats) {
  return run_method(plan, session, {session.buffer(), session.cache()}, repeats);
}

MethodRun run_method(const MethodPlan& plan, Session& session, const MethodSite& site, int repeats) {
  MethodRun run;
  const char* phase = "precompute";
  try {
    const PrepareContext context{session.scene(), session.tracer(),       site.buffer,
                                 plan.knobs,      session.options().seed, *session.gpu(),
                                 site.cache,      session.progress(),     run.precompute,
                                 site.parts,      &session.lighting()};
    const auto start = std::chrono::steady_clock::now();
    const auto prepared = plan.method->prepare(context);
    run.precompute_s = seconds_since(start);
    phase = "relight";
    relight_repeatedly(*prepared, session, repeats, run);
  } catch (const std::bad_alloc&) {
    run.failure = fmt::format("{}: out of memory", phase);
  } catch (const std::exception& error) {
    run.failure = fmt::format("{}: {}", phase, error.what());
  }
  return run;
}

}  // namespace relight
