// A limit on the time of a run, asked at the beginning of stages and whenever progress is reported: an
// exception then unwinds the work, so nothing is torn out of the middle of it.
#pragma once

#include <chrono>
#include <string>

#include "common/run/error.h"

namespace relight {

class TimeLimitReached : public Error {
 public:
  using Error::Error;
};

class TimeLimit {
 public:
  // `seconds` from now are left of the `whole` that is named in the message.
  TimeLimit(double seconds, double whole)
      : whole_(whole),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))) {}
  // Throws TimeLimitReached if no time is left. May be called by many threads.
  void check(const std::string& where) const {
    if (std::chrono::steady_clock::now() > end_)
      throw TimeLimitReached(fmt::format("over its time limit of {:.6g} s, at '{}'", whole_, where));
  }

 private:
  double whole_;
  std::chrono::steady_clock::time_point end_;
};

}  // namespace relight
