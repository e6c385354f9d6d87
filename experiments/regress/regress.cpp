#include "experiments/regress/regress.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/run/record_of.h"
#include "experiments/tables/points.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

// Scenes and lights from files go by the file's name: people start the program in different folders.
std::string base_name(const std::string& name) {
  return name.find('/') == std::string::npos ? name : std::filesystem::path(name).filename().string();
}

bool common_knobs_agree(const RunRecord& a, const RunRecord& b) {
  return std::all_of(a.knobs.begin(), a.knobs.end(), [&](const auto& knob) {
    const auto other = b.knobs.find(knob.first);
    return other == b.knobs.end() || other->second == knob.second;
  });
}

double tolerance_of(const RunRecord& r) { return r.effect_plan ? r.effect_plan->tolerance : -1.0; }

bool of_one_run(const RunRecord& a, const RunRecord& b) {
  return base_name(a.scene) == base_name(b.scene) && base_name(a.lighting) == base_name(b.lighting) &&
         a.view == b.view && a.method == b.method && a.seed == b.seed && tolerance_of(a) == tolerance_of(b) &&
         common_knobs_agree(a, b);
}

std::string label(const RunRecord& r, const std::string& settings) {
  return fmt::format("{} {} {} {}", base_name(r.scene), base_name(r.lighting), r.method, settings);
}

Verdict verdict_of(const RunComparison& run) {
  if (!run.fresh) return Verdict::missing;
  if (!run.published) return Verdict::added;
  const bool changed = std::any_of(run.changes.begin(), run.changes.end(),
                                   [](const Change& c) { return c.weight == Weight::change; });
  return changed ? Verdict::changed : Verdict::same;
}

void add_once(std::vector<std::string>& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void note_machines(const RunComparison& run, std::vector<std::string>& notes) {
  if (!run.published || !run.fresh) return;
  const std::string why = why_times_differ(run.published->provenance, run.fresh->provenance);
  if (!why.empty()) add_once(notes, fmt::format("times not compared: {}", why));
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
      return "same";
    case Verdict::changed:
      return "CHANGED";
    case Verdict::missing:
      return "MISSING";
    case Verdict::added:
      return "new";
  }
  return "";
}

bool Regression::good() const {
  return std::none_of(runs.begin(), runs.end(), [](const RunComparison& run) {
    return run.verdict == Verdict::changed || run.verdict == Verdict::missing;
  });
}

Regression compare_results(const std::string& name, const std::vector<RunRecord>& published,
                           const std::vector<RunRecord>& fresh, const Tolerances& tolerances) {
  Regression out;
  out.name = name;
  const std::vector<std::string> names = tables::labels(published), fresh_names = tables::labels(fresh);
  std::vector<bool> used(fresh.size(), false);
  for (size_t p = 0; p < published.size(); ++p) {
    RunComparison run;
    run.run = label(published[p], names[p]);
    run.published = published[p];
    for (size_t i = 0; i < fresh.size() && !run.fresh; ++i)
      if (!used[i] && of_one_run(published[p], fresh[i])) run.fresh = fresh[i], used[i] = true;
    if (run.fresh) run.changes = find_changes(published[p], *run.fresh, tolerances);
    out.runs.push_back(std::move(run));
  }
  for (size_t i = 0; i < fresh.size(); ++i)
    if (!used[i])
      out.runs.push_back({label(fresh[i], fresh_names[i]), std::nullopt, fresh[i], {}, Verdict::added});
  for (RunComparison& run : out.runs) {
    run.verdict = verdict_of(run);
    note_machines(run, out.notes);
  }
  return out;
}

std::vector<RunRecord> read_results(const std::filesystem::path& folder, std::vector<std::string>& notes) {
  const std::filesystem::path file = folder / "records.jsonl";
  if (!std::filesystem::is_regular_file(file))
    usage_fail(
        "'{}': no such file; `relight run EXPERIMENT --out FOLDER` writes one, `relight publish` keeps it",
        file.string());
  const RecordFile read = read_records(file);
  for (const std::string& warning : read.warnings) add_once(notes, warning);
  return latest_of_each(read.records);
}

}  // namespace relight
