#include "experiments/run/run_experiment.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/run/progress.h"
#include "experiments/run/batch.h"
#include "experiments/run/forecast.h"
#include "experiments/run/record_of.h"
#include "experiments/run/workers.h"
#include "experiments/session/folder_lock.h"
#include "experiments/session/output_folder.h"

namespace relight {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<RunRecord> earlier_records(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  RecordFile read = read_records(file);
  for (const std::string& warning : read.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return std::move(read.records);
}

// The latest good record of this run.
const RunRecord* good_record(const std::vector<RunRecord>& records, const PlannedRun& run) {
  for (size_t i = records.size(); i-- > 0;)
    if (records[i].failed_stages.empty() && is_record_of(records[i], run)) return &records[i];
  return nullptr;
}

// Of all runs in the folder, not only of those that --only named.
std::vector<RunRecord> write_table(const std::filesystem::path& out) {
  std::vector<RunRecord> records = latest_of_each(earlier_records(out / "records.jsonl"));
  write_text_atomically(out / "table.csv", result_csv(records));
  return records;
}

class Runner {
 public:
  Runner(const RunList& list, const std::filesystem::path& out, bool again, bool worker)
      : list_(list),
        out_(out),
        file_(out / "records.jsonl"),
        worker_(worker),
        known_(again ? std::vector<RunRecord>{} : earlier_records(file_)),
        forecasts_(forecasts_for(list, out)),
        records_(list.runs.size()),
        done_(list.runs.size(), false),
        batch_([this](size_t place, RunRecord record) { keep(place, std::move(record)); }) {
    if (worker) return;
    lock_.emplace(out);
    remove_leftovers(out);
  }

  ExperimentResult run() {
    for (size_t i = 0; i < list_.runs.size(); ++i) done_[i] = good_record(known_, list_.runs[i]) != nullptr;
    for (size_t i = 0; i < list_.runs.size(); ++i) {
      const std::optional<RunForecast> forecast = forecasts_.of({list_.runs[i]}, {false}).front();
      if (!batch_.takes(list_.runs[i], forecast ? forecast->bytes : 0)) finish_batch();
      // Asked now: two groups may name one run, which was then done in this session.
      if (const RunRecord* found = good_record(known_, list_.runs[i])) {
        tell(i, ": done before");
        records_[i] = *found, done_[i] = true;
        continue;
      }
      tell(i, time_left());
      batch_.add(list_.runs[i], i, out_ / folder_name(list_.runs[i]));
    }
    finish_batch();
    if (!worker_) write_table(out_);
    return {std::move(records_), std::move(failures_)};
  }

 private:
  void tell(size_t place, const std::string& what) const {
    fmt::print(stderr, "[{}/{}] {}{}\n", place + 1, list_.runs.size(), folder_name(list_.runs[place]), what);
  }

  // By the records so far; while they know nothing of the methods, by the pace so far.
  std::string time_left() const {
    std::optional<double> seconds = seconds_in_all(forecasts_.of(list_.runs, done_), done_);
    const auto left = static_cast<double>(std::count(done_.begin(), done_.end(), false));
    if (!seconds && done_now_ > 0)
      seconds = std::chrono::duration<double>(Clock::now() - start_).count() / done_now_ * left;
    return seconds ? fmt::format(", about {} left", format_duration(*seconds)) : "";
  }

  void finish_batch() {
    if (batch_.size() > 1)
      fmt::print(stderr, "timing {} runs by turns, comparing with the reference\n", batch_.size());
    batch_.finish();
  }

  void keep(size_t place, RunRecord record) {
    try {
      append_record(file_, record);
    } catch (const Error& error) {
      throw OutputError(error.what());
    }
    ++done_now_;
    done_[place] = true;
    for (const std::string& failure : record.failed_stages) {
      failures_.push_back(fmt::format("{}: {}", folder_name(list_.runs[place]), failure));
      fmt::print(stderr, "FAILED {}\n", failures_.back());
    }
    forecasts_.add(record);
    known_.push_back(record);
    records_[place] = std::move(record);
  }

  const RunList& list_;
  const std::filesystem::path out_, file_;
  const bool worker_;
  std::optional<FolderLock> lock_;
  std::vector<RunRecord> known_;
  Forecasts forecasts_;
  std::vector<RunRecord> records_;  // of the list's runs
  std::vector<bool> done_;
  std::vector<std::string> failures_;
  Batch batch_;
  const Clock::time_point start_ = Clock::now();
  int done_now_ = 0;
};

}  // namespace

Forecasts forecasts_for(const RunList& list, const std::filesystem::path& out) {
  Provenance here = collect_provenance("", "");
  if (!list.runs.empty() && list.runs.front().plan.session.threads > 0)
    here.threads = list.runs.front().plan.session.threads;
  std::vector<RunRecord> records;
  const auto read = [&](const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) return;
    for (RunRecord& r : read_records(file).records) records.push_back(std::move(r));
  };
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("results", none))
    read(entry.path() / "records.jsonl");
  read(out / "records.jsonl");
  return {std::move(records), here};
}

std::vector<bool> done_runs(const RunList& list, const std::filesystem::path& out) {
  const std::vector<RunRecord> records = earlier_records(out / "records.jsonl");
  std::vector<bool> done;
  for (const PlannedRun& run : list.runs) done.push_back(good_record(records, run) != nullptr);
  return done;
}

ExperimentResult run_experiment(const RunList& list, const std::filesystem::path& out, bool again,
                                bool worker) {
  try {
    return Runner(list, out, again, worker).run();
  } catch (const OutputError& error) {
    throw OutputError(
        fmt::format("{}\nThe experiment stopped; the runs in '{}' are kept. Make room and start it again: it "
                    "goes on there.",
                    error.what(), (out / "records.jsonl").string()));
  }
}

ExperimentResult run_in_workers(const RunOptions& options, const RunList& list,
                                const std::filesystem::path& out) {
  const FolderLock lock(out);
  remove_leftovers(out);
  std::vector<std::vector<std::string>> commands;
  for (size_t place = 0; place < number_of_places(list); ++place)
    commands.push_back(worker_command(options, out, place));
  ExperimentResult result;
  result.failures = run_workers(commands, options.jobs);
  for (const RunRecord& r : write_table(out))
    for (const std::string& failure : r.failed_stages)
      result.failures.push_back(fmt::format("{}, {}, {}: {}", r.scene, r.lighting, r.method, failure));
  return result;
}

}  // namespace relight
