// `relight regress`: a fresh run of an experiment against the published one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/changes.h"

namespace relight {

enum class Verdict { same, changed, missing, added };
std::string to_string(Verdict verdict);  // "same", "CHANGED", "MISSING", "new"

struct RunComparison {
  std::string run;                            // scene, lights, method, preset, knobs that vary; for people
  std::optional<RunRecord> published, fresh;  // one of them at least
  std::vector<Change> changes;
  Verdict verdict = Verdict::same;
};

struct Regression {
  std::string name;  // of the experiment
  std::vector<RunComparison> runs;
  std::vector<std::string> notes;  // what was not compared and why, and other things to know; one line each
  bool good() const;               // nothing changed and nothing is missing; new runs are no fault
};

// Pairs the records of one run and compares them. Records are of one run if scene, lighting, view, method,
// seed, tolerance of the effect planner and all knobs that both know are the same.
Regression compare_results(const std::string& name, const std::vector<RunRecord>& published,
                           const std::vector<RunRecord>& fresh, const Tolerances& tolerances);

// The latest record of each run in FOLDER/records.jsonl; unreadable lines are added to `notes`. UsageError if
// there is no such file.
std::vector<RunRecord> read_results(const std::filesystem::path& folder, std::vector<std::string>& notes);

// Table, then what changed, run by run.
std::string regression_text(const Regression& regression);

// One self-contained page. `pictures`: the text of `relight references check`, or empty.
std::string regression_page(const std::vector<Regression>& regressions, const std::string& pictures);

}  // namespace relight
