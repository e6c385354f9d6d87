#include "experiments/run/forecast.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiments/options/parse.h"

namespace relight {
namespace {

double pixels_of(const std::string& view) {
  const ViewChoice size = parse_view(view);
  return static_cast<double>(size.width) * static_cast<double>(size.height);
}

bool same_machine(const Provenance& a, const Provenance& b) {
  return a.cpu == b.cpu && a.threads == b.threads && a.build_type == b.build_type;
}

// Knobs of the phases that matter: for the precompute its own, for a relight all.
bool same_knobs(const RunRecord& record, const KnobValues& knobs, bool precompute_only) {
  for (const Knob& knob : knobs.table()) {
    if (precompute_only && knob.phase != KnobPhase::precompute) continue;
    const auto found = record.knobs.find(knob.name);
    if (found == record.knobs.end() || found->second != knobs.all().at(knob.name)) return false;
  }
  return true;
}

constexpr const char* bases[] = {"same scene and settings", "same scene, other settings",
                                 "same settings, other scene", "other scene and settings"};

struct Match {
  const RunRecord* record = nullptr;
  size_t unlike = std::size(bases);  // index into bases
};

// The most alike record, of equals the latest.
Match most_alike(const std::vector<RunRecord>& records, const PlannedRun& run, bool precompute_only) {
  const MethodPlan& method = run.plan.methods.front();
  Match best;
  for (const RunRecord& r : records) {
    if (r.method != method.method->name()) continue;
    const bool scene = r.scene_hash == run.scene_hash, knobs = same_knobs(r, method.knobs, precompute_only);
    const size_t unlike = (scene ? 0u : 2u) + (knobs ? 0u : 1u);
    if (unlike <= best.unlike) best = {&r, unlike};
  }
  return best;
}

std::string place_of(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  return fmt::format("{}\n{}\n{}\n{}", s.scene, s.lights, s.view, s.seed);
}

double setup_s(const RunRecord& record) {
  double sum = 0.0;
  for (const auto& [stage, seconds] : record.setup_stages) sum += seconds;
  return sum;
}

// Tracing the reference anew, by the record of the same scene, or any, that traced one.
double reference_s(const std::vector<RunRecord>& records, const PlannedRun& run) {
  const RunRecord* best = nullptr;
  for (const RunRecord& r : records)
    if (r.reference && !r.reference->from_cache &&
        (!best || r.scene_hash == run.scene_hash || best->scene_hash != run.scene_hash))
      best = &r;
  if (!best) return 0.0;
  return best->reference->seconds * pixels_of(run.plan.session.view) / pixels_of(best->view) *
         run.plan.reference_samples / static_cast<double>(std::max<int64_t>(1, best->reference->samples));
}

// One to warm up, and as many as are timed, each third of them after another that is not timed.
double relights(int repeats) {
  return 1.0 + (repeats > 0 ? repeats : 5) + std::min(3, repeats > 0 ? repeats : 5);
}

}  // namespace

Forecasts::Forecasts(std::vector<RunRecord> records, Provenance here) : here_(std::move(here)) {
  for (const RunRecord& record : records) add(record);
}

void Forecasts::add(const RunRecord& r) {
  if (r.failed_stages.empty() && same_machine(r.provenance, here_) && !r.provenance.shared_machine &&
      r.relight_ms.repeats > 0)
    records_.push_back(r);
}

std::vector<std::optional<RunForecast>> Forecasts::of(const std::vector<PlannedRun>& runs,
                                                      const std::vector<bool>& done) const {
  std::vector<std::optional<RunForecast>> out;
  std::set<std::string> prepared, references;
  for (size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& run = runs[i];
    const MethodPlan& method = run.plan.methods.front();
    const SessionOptions& s = run.plan.session;
    const Match precompute = most_alike(records_, run, true), relight = most_alike(records_, run, false);
    if (!precompute.record || done[i]) {
      out.push_back(done[i] ? std::optional(RunForecast{}) : std::nullopt);
      continue;
    }
    RunForecast forecast;
    const double scale = pixels_of(s.view) / pixels_of(precompute.record->view);
    const std::string data = fmt::format("{}\n{}\n{}\n{}\n{}", s.scene, s.view, s.seed, method.method->name(),
                                         method.knobs.precompute_key());
    if (s.no_cache || prepared.insert(data).second)
      forecast.precompute_s = scale * precompute.record->precompute_s;
    forecast.relights_s = 1e-3 * relight.record->relight_ms.median * relights(run.plan.repeats) *
                          pixels_of(s.view) / pixels_of(relight.record->view);
    if (references.insert(place_of(run) + method.paths.to_string()).second)
      forecast.reference_s = reference_s(records_, run);
    if (references.insert(place_of(run)).second) forecast.reference_s += setup_s(*precompute.record);
    forecast.bytes = static_cast<int64_t>(scale * static_cast<double>(prepared_bytes(*precompute.record)));
    forecast.basis = bases[std::max(precompute.unlike, relight.unlike)];
    out.push_back(forecast);
  }
  return out;
}

std::optional<double> seconds_in_all(const std::vector<std::optional<RunForecast>>& forecasts,
                                     const std::vector<bool>& done) {
  double sum = 0.0;
  size_t known = 0, unknown = 0;
  for (size_t i = 0; i < forecasts.size(); ++i) {
    if (done[i]) continue;
    if (forecasts[i])
      sum += forecasts[i]->seconds(), ++known;
    else
      ++unknown;
  }
  if (known == 0) return unknown > 0 ? std::nullopt : std::optional(0.0);
  return sum * static_cast<double>(known + unknown) / static_cast<double>(known);
}

}  // namespace relight
