// What a run did and what it cost: named stages with wall time, counters, bytes by artefact, warnings.
// One log per phase (precompute, relight); written into the run record. Not thread-safe: log from the calling
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace relight {

class StageLog {
 public:
  // Adds seconds to a stage; stages keep the order of their first use.
  void add_seconds(const std::string& stage, double seconds);
  void count(const std::string& counter, int64_t n) { counters_[counter] += n; }
  void bytes(const std::string& artefact, int64_t n) { bytes_[artefact] = n; }
  void warn(const std::string& sentence) { warnings_.push_back(sentence); }

  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }
  const std::map<std::string, int64_t>& counters() const { return counters_; }
  const std::map<std::string, int64_t>& bytes() const { return bytes_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  double total_seconds() const;

 private:
  std::vector<std::pair<std::string, double>> stages_;
  std::map<std::string, int64_t> counters_, bytes_;
  std::vector<std::string> warnings_;
};

// Times its own lifetime on the steady wall clock and adds it to a stage.
class StageTimer {
 public:
  StageTimer(StageLog& log, std::string stage)
      : log_(log), stage_(std::move(stage)), start_(std::chrono::steady_clock::now()) {}
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
