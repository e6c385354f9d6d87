#include "experiments/compare/prepared_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numeric>

#include "common/run/error.h"

namespace relight {

namespace {

constexpr int default_repeats = 5;
constexpr double repeat_budget_s = 20.0;  // a slow method (path tracing) must not take six times its time
constexpr int rounds = 3;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Keeping data for another run is this program's cost, not the method's; finding them is its luck.
double without_cache(double seconds, const StageLog& log) {
  for (const auto& [stage, s] : log.stages())
    if (stage == "cache_load" || stage == "cache_store") seconds -= s;
  return std::max(0.0, seconds) + log.restored_seconds();
}

void require_size(const Image& image, const char* name, const View& view) {
  if (image.width != view.width || image.height != view.height) {
    fail("the {} image has {}x{} pixels where the view has {}x{}", name, image.width, image.height,
         view.width, view.height);
  }
}

int number_of_repeats(int wanted, double one_relight_s) {
  if (wanted > 0) return wanted;
  return std::clamp(static_cast<int>(std::min(repeat_budget_s / std::max(one_relight_s, 1e-3), 1e3)), 1,
                    default_repeats);
}

}  // namespace

PreparedRun::PreparedRun(const MethodPlan& plan, Session& session, const MethodSite& site, int repeats)
    : plan_(plan),
      session_(session),
      site_(site),
      context_{session.scene(),        session.tracer(), site_.buffer,       plan_.knobs,
               session.options().seed, *session.gpu(),   site_.cache,        session.progress(),
               run_.precompute,        site_.parts,      &session.lighting()} {
  attempt("precompute", [&] {
    run_.precompute.set_limit(session_.progress().limit());
    const auto start = std::chrono::steady_clock::now();
    prepared_ = plan_.method->prepare(context_);
    run_.precompute_s = without_cache(seconds_since(start), run_.precompute);
  });
  attempt("relight", [&] {
    StageLog log;
    repeats_ = number_of_repeats(repeats, relight_once(log));
  });
}

// Whatever a run does, under what is left of its time limit.
void PreparedRun::attempt(const char* phase, const std::function<void()>& work) {
  if (failed()) return;
  const auto start = std::chrono::steady_clock::now();
  Progress& progress = session_.progress();
  if (site_.time_limit_s > 0.0)
    progress.set_limit(TimeLimit(site_.time_limit_s - used_s_, site_.whole_limit_s));
  try {
    work();
  } catch (const std::bad_alloc&) {
    run_.failure = fmt::format("{}: out of memory", phase);
  } catch (const std::exception& error) {
    run_.failure = fmt::format("{}: {}", phase, error.what());
  }
  progress.set_limit(std::nullopt);
  used_s_ += seconds_since(start);
}

double PreparedRun::relight_once(StageLog& log) {
  log.set_limit(session_.progress().limit());
  log.begin("relight");
  prepared_->forget();  // the same lighting again would cost next to nothing
  const auto start = std::chrono::steady_clock::now();
  run_.relit = prepared_->relight(session_.lighting(), log);
  const double seconds = seconds_since(start);
  const View& view = session_.buffer().view;
  require_size(run_.relit.direct, "direct", view);
  require_size(run_.relit.indirect, "indirect", view);
  require_size(run_.relit.total, "total", view);
  return seconds;
}

void PreparedRun::relight_timed() {
  attempt("relight", [&] {
    StageLog log;
    run_.relight_ms.push_back(1e3 * relight_once(log));
    logs_.push_back(std::move(log));
  });
}

void PreparedRun::relight_untimed() {
  attempt("relight", [&] {
    StageLog log;
    relight_once(log);
  });
}

int64_t PreparedRun::bytes() const {
  int64_t sum = 0;
  for (const auto& [artefact, n] : run_.precompute.bytes()) sum += n;
  for (const Image* image : {&run_.relit.direct, &run_.relit.indirect, &run_.relit.total})
    sum += static_cast<int64_t>(image->pixels.size() * sizeof(glm::vec3));
  return sum;
}

MethodRun PreparedRun::finish() {
  prepared_.reset();
  if (logs_.empty()) return std::move(run_);
  // The stages shown must add up to the time shown, so they come from one relight: the (lower) median one.
  std::vector<size_t> order(logs_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return run_.relight_ms[a] < run_.relight_ms[b]; });
  run_.relight = logs_[order[(order.size() - 1) / 2]];
  return std::move(run_);
}

void time_in_rounds(const std::vector<PreparedRun*>& runs) {
  const bool alone = runs.size() == 1;
  std::vector<PreparedRun*> order = runs;
  for (int round = 0; round < rounds; ++round) {
    for (PreparedRun* run : order) {
      const int share = run->repeats() * (round + 1) / rounds - run->repeats() * round / rounds;
      if (share > 0 && !alone) run->relight_untimed();
      for (int i = 0; i < share; ++i) run->relight_timed();
    }
    std::reverse(order.begin(), order.end());
  }
}

}  // namespace relight
