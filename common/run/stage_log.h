// What a run did and what it cost: named stages with wall time, counters, bytes by artefact, warnings.
// One log per phase (precompute, relight); written into the run record. Not thread-safe: log from the calling
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/run/time_limit.h"

namespace relight {

class StageLog {
 public:
  // Adds seconds to a stage; stages keep the order of their first use.
  void add_seconds(const std::string& stage, double seconds);
  void count(const std::string& counter, int64_t n) { counters_[counter] += n; }
  void bytes(const std::string& artefact, int64_t n) { bytes_[artefact] = n; }
  void warn(const std::string& sentence) { warnings_.push_back(sentence); }
  // Everything that `other` holds: seconds and counters are added to what is here.
  void add(const StageLog& other);
  // Seconds that data taken from the cache took when they were made; they are among the stages, but were not
  // spent now.
  void add_restored_seconds(double seconds) { restored_s_ += seconds; }

  // Stages that begin after the limit throw TimeLimitReached.
  void set_limit(std::optional<TimeLimit> limit) { limit_ = std::move(limit); }
  const std::optional<TimeLimit>& limit() const { return limit_; }
  void begin(const std::string& stage) const {
    if (limit_) limit_->check(stage);
  }

  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }
  const std::map<std::string, int64_t>& counters() const { return counters_; }
  const std::map<std::string, int64_t>& bytes() const { return bytes_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  double total_seconds() const;
  double restored_seconds() const { return restored_s_; }

 private:
  std::vector<std::pair<std::string, double>> stages_;
  std::map<std::string, int64_t> counters_, bytes_;
  std::vector<std::string> warnings_;
  double restored_s_ = 0.0;
  std::optional<TimeLimit> limit_;
};

// Times its own lifetime on the steady wall clock and adds it to a stage.
class StageTimer {
 public:
  StageTimer(StageLog& log, std::string stage)
      : log_(log), stage_(std::move(stage)), start_(std::chrono::steady_clock::now()) {
    log_.begin(stage_);
  }
  ~StageTimer() {
    log_.add_seconds(stage_,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  StageLog& log_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace relight
