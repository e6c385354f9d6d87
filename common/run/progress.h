// Progress with time left, on standard error, for work that takes long. Thread-safe.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "common/run/time_limit.h"

namespace relight {

// "12 s", "1 min 10 s", "2 h 5 min"; "under 1 s" below half a second. Rounded, for people.
std::string format_duration(double seconds);
// "reference  42 %  1 min 10 s left": the time left assumes that the rest goes as fast as what is done; it is
// left out while nothing is done. total <= 0 (unknown) gives the count alone.
std::string format_progress(const std::string& what, int64_t done, int64_t total, double elapsed_seconds);

class Progress {
 public:
  // `quiet` prints nothing. On a terminal the line is rewritten twice a second; otherwise a line every 10 s.
  explicit Progress(bool quiet = false) : quiet_(quiet) {}
  // start and advance throw TimeLimitReached once a limit that was set has passed.
  void start(const std::string& what, int64_t total);
  void advance(int64_t done = 1);
  void finish();
  // Not while work is reported.
  void set_limit(std::optional<TimeLimit> limit) { limit_ = std::move(limit); }
  const std::optional<TimeLimit>& limit() const { return limit_; }

 private:
  void print(bool last);
  bool quiet_;
  std::string what_;
  int64_t total_ = 0;
  std::atomic<int64_t> done_{0};
  std::chrono::steady_clock::time_point start_, last_print_;
  std::mutex mutex_;
  std::optional<TimeLimit> limit_;
};

}  // namespace relight
