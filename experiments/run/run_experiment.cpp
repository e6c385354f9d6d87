#include "experiments/run/run_experiment.h"

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/run/progress.h"
#include "experiments/compare/compare.h"
#include "experiments/effects/plan_effects.h"

namespace relight {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string folder_name(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  std::string name = fmt::format("{}_{}_{}_{}", std::filesystem::path(s.scene).stem().string(),
                                 std::filesystem::path(s.lights).stem().string(),
                                 run.plan.methods.front().method->name(), run.label);
  for (char& c : name)
    if (c == ' ' || c == '/' || c == ':') c = '_';
  return name;
}

std::vector<RunRecord> earlier_records(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  RecordFile read = read_records(file);
  for (const std::string& warning : read.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return std::move(read.records);
}

// Of records of the same run the last; in the order in which the runs were first done.
std::vector<RunRecord> latest_of_each(const std::vector<RunRecord>& records) {
  std::vector<RunRecord> latest;
  std::map<std::string, size_t> place;
  for (const RunRecord& r : records) {
    std::string key = fmt::format("{}\n{}\n{}\n{}\n{}", r.scene, r.lighting, r.view, r.method, r.seed);
    for (const auto& [knob, value] : r.knobs) key += "\n" + knob + "=" + value;
    if (r.effect_plan) key += fmt::format("\ntolerance={}", r.effect_plan->tolerance);
    const auto [at, is_new] = place.try_emplace(key, latest.size());
    if (is_new)
      latest.push_back(r);
    else
      latest[at->second] = r;
  }
  return latest;
}

// Scene, view and tracer are kept from run to run while they stay the same.
class Sessions {
 public:
  Session& of(const PlannedRun& run) {
    const SessionOptions& s = run.plan.session;
    const std::string key = fmt::format("{}\n{}\n{}", s.scene, s.lights, s.seed);
    if (!session_ || key != key_) {
      session_.reset();  // two of them would need the memory of two
      session_ = std::make_unique<Session>(s, Session::Gpu::needed);
      key_ = key;
    }
    return *session_;
  }

 private:
  std::string key_;
  std::unique_ptr<Session> session_;
};

// Errors that concern one run only become a failed record.
RunRecord run_one(const PlannedRun& run, Sessions& sessions, const std::filesystem::path& folder) {
  RunRecord record;
  record.scene = run.plan.session.scene, record.lighting = run.plan.session.lights;
  record.view = run.plan.session.view, record.seed = run.plan.session.seed;
  const MethodPlan& method = run.plan.methods.front();
  record.method = method.method->name(), record.preset = method.preset, record.knobs = method.knobs.all();
  try {
    return Comparison(run.plan, sessions.of(run)).run(method, folder);
  } catch (const std::bad_alloc&) {
    record.failed_stages.push_back("out of memory");
  } catch (const std::exception& error) {
    record.failed_stages.push_back(error.what());
  }
  return record;
}

}  // namespace

namespace {

// The knobs that the run has once the record's plan is applied; nothing if the record has no plan that was
// asked for in the same words.
std::optional<KnobValues> knobs_of(const PlannedRun& run, const RunRecord& record) {
  const KnobValues& knobs = run.plan.methods.front().knobs;
  const auto& wanted = run.plan.effects;
  if (!wanted) return record.effect_plan ? std::nullopt : std::optional(knobs);
  const auto& plan = record.effect_plan;
  if (!plan || plan->tolerance != wanted->tolerance || plan->asked != wanted->asked) return std::nullopt;
  if (wanted->check && !(plan->check && plan->check->everything)) return std::nullopt;
  try {
    return planned_knobs(knobs, *plan);
  } catch (const Error&) {  // of another version of the method
    return std::nullopt;
  }
}

}  // namespace

bool is_record_of(const RunRecord& record, const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  const MethodPlan& method = run.plan.methods.front();
  const std::optional<KnobValues> knobs = knobs_of(run, record);
  return knobs && record.scene == s.scene && record.lighting == s.lights && record.view == s.view &&
         record.scene_hash == run.scene_hash && record.seed == s.seed &&
         record.method == method.method->name() && record.knobs == knobs->all() && record.reference &&
         record.reference->samples >= run.plan.reference_samples;
}

ExperimentResult run_experiment(const RunList& list, const std::filesystem::path& out, bool again) {
  const std::filesystem::path file = out / "records.jsonl";
  std::vector<RunRecord> earlier = earlier_records(file);
  ExperimentResult result;
  Sessions sessions;
  const auto start = Clock::now();
  size_t done_now = 0, number = 0;
  for (const PlannedRun& run : list.runs) {
    ++number;
    const std::string name = folder_name(run);
    const RunRecord* found = nullptr;
    for (const RunRecord& r : earlier)
      if (!again && r.failed_stages.empty() && is_record_of(r, run)) found = &r;
    if (found) {
      fmt::print(stderr, "[{}/{}] {}: done before\n", number, list.runs.size(), name);
      result.records.push_back(*found);
      continue;
    }
    const std::string left =
        done_now == 0 ? ""
                      : fmt::format(", about {} left",
                                    format_duration(seconds_since(start) / static_cast<double>(done_now) *
                                                    static_cast<double>(list.runs.size() - number + 1)));
    fmt::print(stderr, "[{}/{}] {}{}\n", number, list.runs.size(), name, left);
    result.records.push_back(run_one(run, sessions, out / name));
    append_record(file, result.records.back());
    ++done_now;
    for (const std::string& failure : result.records.back().failed_stages) {
      result.failures.push_back(fmt::format("{}: {}", name, failure));
      fmt::print(stderr, "FAILED {}\n", result.failures.back());
    }
  }
  // Of all runs in the folder, not only of those that --only named.
  write_text_atomically(out / "table.csv", result_csv(latest_of_each(earlier_records(file))));
  return result;
}

}  // namespace relight
