// `relight run`: the runs of an experiment one after the other; resumable.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/run/experiment.h"

namespace relight {

struct RunOptions {
  std::string experiment;  // file
  std::string out;         // folder; empty: out/<experiment>
  std::string only;        // only runs whose scene, lights, method or label contains this
  bool dry_run = false;
  bool again = false;  // run also what has a good record already
  SessionOptions session;
};

struct ExperimentResult {
  std::vector<RunRecord> records;     // of this experiment's runs, in its order; those that failed too
  std::vector<std::string> failures;  // one sentence each
};

// A record of exactly this run: scene with its content, view, lighting, method, every knob, seed and
// reference.
bool is_record_of(const RunRecord& record, const PlannedRun& run);

// Writes OUT/records.jsonl (a line as soon as a run is done), OUT/<scene>_<lights>_<method>_<label>/*.exr and
// OUT/table.csv, which holds every run in the folder. A run that has a record without failures is not run
// again; one that fails is reported and the others go on. Says on standard error what runs, and how long the
// rest will take at the pace so far.
ExperimentResult run_experiment(const RunList& list, const std::filesystem::path& out, bool again);

// One line a run: settings that vary, errors, times, bytes; for spreadsheets and plots.
std::string result_csv(const std::vector<RunRecord>& records);

}  // namespace relight
