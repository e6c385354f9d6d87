#include "common/run/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace relight {

namespace {

// A terminal line is rewritten often; a log file should not fill with lines.
constexpr std::chrono::milliseconds terminal_interval{500};
constexpr std::chrono::milliseconds log_interval{10'000};

bool standard_error_is_terminal() {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  return terminal;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::string format_duration(double seconds) {
  if (!(seconds >= 0.5)) return "under 1 s";
  // A forecast from a first step that barely advanced may be absurdly long.
  if (seconds > 1e9) return "years";
  const int64_t whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string format_progress(const std::string& what, int64_t done, int64_t total, double elapsed_seconds) {
  if (total <= 0) return fmt::format("{}  {} done", what, done);
  // More work than announced must not read as 101 %.
  const double share = std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0);
  const std::string percent = fmt::format("{}  {:.0f} %", what, std::floor(100.0 * share));
  if (share <= 0.0) return percent;
  return fmt::format("{}  {} left", percent, format_duration(elapsed_seconds * (1.0 - share) / share));
}

void Progress::start(const std::string& what, int64_t total) {
  const std::lock_guard lock(mutex_);
  what_ = what;
  total_ = total;
  done_ = 0;
  start_ = last_print_ = std::chrono::steady_clock::now();
  if (limit_) limit_->check(what_);
}

void Progress::advance(int64_t done) {
  done_ += done;
  if (limit_) limit_->check(what_);
  if (quiet_) return;
  // Workers never wait for each other's printing: whoever finds the lock taken goes on.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto interval = standard_error_is_terminal() ? terminal_interval : log_interval;
  if (std::chrono::steady_clock::now() - last_print_ >= interval) print(false);
}

void Progress::finish() {
  const std::lock_guard lock(mutex_);
  if (!quiet_) print(true);
  what_.clear();
}

void Progress::print(bool last) {
  last_print_ = std::chrono::steady_clock::now();
  const double elapsed = seconds_since(start_);
  const std::string line = last ? fmt::format("{}  done in {}", what_, format_duration(elapsed))
                                : format_progress(what_, done_, total_, elapsed);
  // "\r" returns to the line's start and "ESC [K" clears what a longer line left behind.
  if (standard_error_is_terminal())
    fmt::print(stderr, "\r{}\033[K{}", line, last ? "\n" : "");
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
}

}  // namespace relight
