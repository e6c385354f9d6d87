// Runs on one session that are prepared one after the other and timed by turns.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/compare.h"
#include "experiments/run/experiment.h"

namespace relight {

class Batch {
 public:
  // `keep` gets the record of each run, in the order in which they were added, with its place in the list.
  using Keep = std::function<void(size_t place, RunRecord record)>;
  explicit Batch(Keep keep) : keep_(std::move(keep)) {}

  // Can `run`, whose prepared data are expected to need `bytes`, be added to what is waiting? Not if it is on
  // another scene, lighting or view, is the same run again, measures its effects (it then runs beside a
  // second one of its own), or if there are eight, or a quarter of the machine's memory is needed for those
  // that wait.
  bool takes(const PlannedRun& run, int64_t bytes) const;
  // Prepares and warms up. `images`: folder. What concerns this run only becomes a failed record.
  void add(const PlannedRun& run, size_t place, const std::filesystem::path& images);
  // Times what is waiting, finishes it and hands the records over. Throws OutputError.
  void finish();
  bool empty() const { return waiting_.empty(); }
  size_t size() const { return waiting_.size(); }

 private:
  struct Waiting {
    const PlannedRun* run;
    size_t place;
    std::filesystem::path images;
    std::unique_ptr<Comparison> comparison;
    StartedRun started;
  };
  Session& session_of(const PlannedRun& run);
  RunRecord finish_one(Waiting& waiting);
  int64_t bytes() const;

  Keep keep_;
  std::string key_;                   // of the session
  std::unique_ptr<Session> session_;  // kept from run to run while scene, lighting and seed stay the same
  ReferenceStore references_;
  std::vector<Waiting> waiting_;
};

}  // namespace relight
