// What the runs of an experiment will cost, from records of earlier runs on this machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/run/experiment.h"

namespace relight {

struct RunForecast {
  double precompute_s = 0.0;  // 0 if an earlier run of the list leaves the data in the cache
  double relights_s = 0.0;    // all of them, those to warm up too
  double reference_s = 0.0;   // and loading the scene; 0 but for the first run that needs them
  int64_t bytes = 0;          // of prepared data, in memory
  std::string basis;          // what it rests on: "same scene and settings", ...
  double seconds() const { return precompute_s + relights_s + reference_s; }
};

class Forecasts {
 public:
  // Of `records` only good ones of this machine (processor, threads, build type) count.
  Forecasts(std::vector<RunRecord> records, Provenance here);
  void add(const RunRecord& record);
  size_t records() const { return records_.size(); }

  // One for each run, in the order of the list; nothing where no record of its method is known. Times and
  // bytes are those of the most alike record (same scene before same settings), scaled by the number of
  // pixels. Done runs (`done`, one entry a run) cost nothing.
  std::vector<std::optional<RunForecast>> of(const std::vector<PlannedRun>& runs,
                                             const std::vector<bool>& done) const;

 private:
  std::vector<RunRecord> records_;
  Provenance here_;
};

// Seconds of all runs that are not done: unknown ones cost what the known ones do on average; nothing if none
// is known.
std::optional<double> seconds_in_all(const std::vector<std::optional<RunForecast>>& forecasts,
                                     const std::vector<bool>& done);

// The plan as a table with a line a run, sums, and what the estimate rests on.
std::string plan_text(const std::vector<PlannedRun>& runs, const std::vector<bool>& done,
                      const Forecasts& forecasts);

}  // namespace relight
