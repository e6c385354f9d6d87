#include "experiments/run/record_of.h"

#include <map>
#include <optional>

#include "common/run/error.h"
#include "experiments/effects/plan_effects.h"

namespace relight {
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
         record.scene_hash == run.scene_hash && record.view_hash == run.view_hash &&
         record.lighting_hash == run.lighting_hash && record.seed == s.seed &&
         record.method == method.method->name() && record.knobs == knobs->all() && record.reference &&
         record.reference->samples >= run.plan.reference_samples;
}

std::string run_words(const RunRecord& r) {
  std::string words = fmt::format("{}\n{}\n{}\n{}\n{}", r.scene, r.lighting, r.view, r.method, r.seed);
  for (const auto& [knob, value] : r.knobs) words += "\n" + knob + "=" + value;
  if (r.effect_plan) words += fmt::format("\ntolerance={}", r.effect_plan->tolerance);
  return words;
}

std::vector<RunRecord> latest_of_each(const std::vector<RunRecord>& records) {
  std::vector<RunRecord> latest;
  std::map<std::string, size_t> place;
  for (const RunRecord& r : records) {
    const auto [at, is_new] = place.try_emplace(run_words(r), latest.size());
    if (is_new)
      latest.push_back(r);
    else
      latest[at->second] = r;
  }
  return latest;
}

}  // namespace relight
