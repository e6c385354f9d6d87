// `relight run`: the runs of an experiment one after the other; resumable.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/run/experiment.h"
#include "experiments/run/forecast.h"

namespace relight {

struct RunOptions {
  std::string experiment;  // file
  std::string out;         // folder; empty: out/<experiment>
  std::string only;        // only runs whose scene, lights, method or label contains this
  bool dry_run = false;
  bool again = false;          // run also what has a good record already
  double time_limit_s = -1.0;  // < 0: what the file says; 0: none
  int jobs = 1;                // processes at a time
  int place = -1;              // >= 0: this process is one of them and runs this place only (workers.h)
  SessionOptions session;
};

struct ExperimentResult {
  std::vector<RunRecord> records;     // of this experiment's runs, in its order; those that failed too
  std::vector<std::string> failures;  // one sentence each
};

// From the good records in results/*/records.jsonl below the current folder, and in OUT.
Forecasts forecasts_for(const RunList& list, const std::filesystem::path& out);

// Which runs of the list have a good record in OUT.
std::vector<bool> done_runs(const RunList& list, const std::filesystem::path& out);

// Writes OUT/records.jsonl (a line as soon as a run is done), OUT/<scene>_<lights>_<method>_<label>/*.exr and
// OUT/table.csv, which holds every run in the folder. A run that has a record without failures is not run
// again; one that fails is reported and the others go on. Runs are timed by turns (batch.h). Throws
// OutputError at once if results cannot be written; what was written before is kept. Error if another process
// is at work in OUT. Says on standard error what runs, and how long the rest will take.
// `worker`: one of several processes at work in OUT; the one that started them holds the lock and writes the
// table.
ExperimentResult run_experiment(const RunList& list, const std::filesystem::path& out, bool again,
                                bool worker = false);

// The same by `jobs` processes, each with the runs of one scene and lighting. Returns failures only; their
// records say shared_machine, because their times are those of a machine that had more to do.
ExperimentResult run_in_workers(const RunOptions& options, const RunList& list,
                                const std::filesystem::path& out);

// One line a run: settings that vary, errors, times, bytes; for spreadsheets and plots.
std::string result_csv(const std::vector<RunRecord>& records);

}  // namespace relight
