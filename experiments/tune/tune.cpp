#include "experiments/tune/tune.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>

#include "common/run/error.h"
#include "common/run/progress.h"
#include "experiments/tune/setting_records.h"
#include "experiments/tune/verify_lights.h"

namespace relight {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::map<std::string, std::string> changed_knobs(const MethodPlan& method) {
  std::map<std::string, std::string> changed;
  const KnobValues defaults(method.method->knobs());
  for (const auto& [knob, value] : method.knobs.all())
    if (defaults.all().at(knob) != value) changed[knob] = value;
  return changed;
}

// A share of what is left of both budgets for each method.
struct Budget {
  double seconds;
  int64_t runs;
};

class Tuner {
 public:
  Tuner(const TunePlan& plan, Session& session)
      : plan_(plan),
        session_(session),
        compare_(compare_plan(plan)),
        comparison_(compare_, session, references_),
        records_(plan) {}

  void search(const std::vector<MethodPlan>& starts, size_t methods_left, TuneResult& result) {
    const Budget budget{
        seconds_since(start_) + (plan_.budget_s - seconds_since(start_)) / double(methods_left),
        runs_ + (plan_.runs - runs_) / static_cast<int64_t>(methods_left)};
    const MethodPlan& first = starts.front();
    TuneSearch search(
        plan_.bounds, first.fixed,
        [&](const KnobValues& knobs, const std::string& why) {
          return measure(first, knobs, why, budget, result);
        },
        [&] { return seconds_since(start_) < budget.seconds && runs_ < budget.runs; },
        [&](const KnobValues& from, const KnobValues& to) {
          return same_paths(first.method->light_paths(from), first.method->light_paths(to));
        });
    std::vector<std::pair<KnobValues, std::string>> points;
    for (const MethodPlan& s : starts) points.emplace_back(s.knobs, "preset " + s.preset);
    if (!search.run(points)) result.unfinished.push_back(first.method->name());
  }

  // Of a setting tried.
  const MethodPlan& plan_of(size_t tried) const { return plans_.at(tried); }

 private:
  Outcome measure(const MethodPlan& like, const KnobValues& knobs, const std::string& why,
                  const Budget& budget, TuneResult& result) {
    MethodPlan method = like;
    method.knobs = knobs, method.paths = like.method->light_paths(knobs);
    tell(like.method->name(), why, budget);
    ++runs_;
    const RunRecord& record = records_.of(method, session_, comparison_);
    const Outcome outcome = outcome_of(record, plan_.metric);
    if (!outcome.failure.empty()) fmt::print(stderr, "FAILED {}\n", outcome.failure);
    result.tried.push_back({like.method->name(), why, changed_knobs(method), outcome, record.command});
    if (result.provenance.commit.empty()) result.provenance = record.provenance;
    plans_.push_back(std::move(method));
    return outcome;
  }

  void tell(const std::string& method, const std::string& why, const Budget& budget) const {
    if (plan_.session.quiet) return;
    double left = budget.seconds - seconds_since(start_);
    if (const int64_t now = records_.measured_now(); now > 0)
      left = std::min(left, seconds_since(start_) / double(now) * double(budget.runs - runs_));
    fmt::print(stderr, "[{}/{}] {}: {}; this method at most {} more\n", runs_ + 1, budget.runs, method, why,
               format_duration(std::max(left, 0.0)));
  }

  const TunePlan& plan_;
  Session& session_;
  ComparePlan compare_;
  ReferenceStore references_;
  Comparison comparison_;
  SettingRecords records_;
  std::vector<MethodPlan> plans_;  // of each setting tried
  int64_t runs_ = 0;
  Clock::time_point start_ = Clock::now();
};

// The cheapest that keeps the bounds, over all methods; else the closest.
void choose(const TuneBounds& bounds, TuneResult& result) {
  for (size_t i = 0; i < result.tried.size(); ++i)
    if (result.chosen == SIZE_MAX ||
        better(result.tried[i].outcome, result.tried[result.chosen].outcome, bounds, 0.0))
      result.chosen = i;
  result.keeps_bounds =
      result.chosen != SIZE_MAX && violation(result.tried[result.chosen].outcome, bounds) == 0.0;
}

Verification verify(const TunePlan& plan, const MethodPlan& method, const std::string& lights,
                    SettingRecords& records) {
  if (!plan.session.quiet) fmt::print(stderr, "verifying under '{}'\n", lights);
  SessionOptions options = plan.session;
  options.lights = lights;
  Session session(options, Session::Gpu::needed);
  ComparePlan compare = compare_plan(plan);
  compare.session = options;
  ReferenceStore references;
  Comparison comparison(compare, session, references);
  const Outcome outcome = outcome_of(records.of(method, session, comparison), plan.metric);
  return {lights, outcome, error_verdict(outcome, plan.bounds.error)};
}

}  // namespace

BoundVerdict error_verdict(const Outcome& outcome, double bound) {
  if (!outcome.failure.empty() || !(outcome.error - outcome.half_width <= bound))
    return BoundVerdict::not_met;
  return outcome.error + outcome.half_width <= bound ? BoundVerdict::met : BoundVerdict::open;
}

std::string to_string(BoundVerdict verdict) {
  return verdict == BoundVerdict::met ? "met" : verdict == BoundVerdict::open ? "open" : "not met";
}

int64_t TuneResult::met() const {
  return std::count_if(verified.begin(), verified.end(),
                       [](const Verification& v) { return v.verdict == BoundVerdict::met; });
}

TuneResult tune(const TunePlan& plan) {
  TuneResult result;
  std::vector<std::string> verify_lights = plan.verify_lights;
  std::optional<MethodPlan> chosen;
  {
    Session session(plan.session, Session::Gpu::needed);
    result.scene = plan.session.scene, result.lights = session.lighting_name(),
    result.view = plan.session.view;
    // Names are checked before hours are spent on the search.
    for (const std::string& lights : verify_lights) load_named_lighting(session.scene(), lights);
    if (verify_lights.empty()) verify_lights = choose_verify_lights(session, plan.out);
    Tuner tuner(plan, session);
    for (size_t m = 0; m < plan.starts.size(); ++m)
      tuner.search(plan.starts[m], plan.starts.size() - m, result);
    choose(plan.bounds, result);
    if (result.chosen != SIZE_MAX && result.tried[result.chosen].outcome.failure.empty())
      chosen = tuner.plan_of(result.chosen);
  }
  if (!chosen) return result;
  SettingRecords known(plan);
  for (const std::string& lights : verify_lights)
    result.verified.push_back(verify(plan, *chosen, lights, known));
  return result;
}

}  // namespace relight
