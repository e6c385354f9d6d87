#include "experiments/hard_cases/run_hard_cases.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>

#include <fmt/format.h>

#include "common/run/progress.h"

namespace relight {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool HardCaseOutcome::holds() const {
  return failure.empty() && !figures.empty() &&
         std::all_of(figures.begin(), figures.end(), [](const hard::Figure& f) { return f.holds(); });
}

HardCaseOutcome run_hard_case(const HardCase& hard_case) {
  HardCaseOutcome outcome{hard_case.owner, hard_case.of.name, hard_case.of.breaks, {}, "", 0.0};
  const auto start = std::chrono::steady_clock::now();
  try {
    outcome.figures = hard_case.of.measure();
    if (outcome.figures.empty()) outcome.failure = "it measured nothing";
  } catch (const std::bad_alloc&) {
    outcome.failure = "out of memory";
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.seconds = seconds_since(start);
  return outcome;
}

std::vector<HardCaseOutcome> run_hard_cases(const std::vector<HardCase>& cases, bool quiet) {
  std::vector<HardCaseOutcome> outcomes;
  const auto start = std::chrono::steady_clock::now();
  for (const HardCase& c : cases) {
    if (!quiet)
      fmt::print(stderr, "{}: {}\n",
                 format_progress("hard cases", static_cast<int64_t>(outcomes.size()),
                                 static_cast<int64_t>(cases.size()), seconds_since(start)),
                 title(c));
    outcomes.push_back(run_hard_case(c));
    if (!quiet && !outcomes.back().holds()) fmt::print(stderr, "BROKEN {}\n", title(c));
  }
  return outcomes;
}

int64_t broken(const std::vector<HardCaseOutcome>& outcomes) {
  return std::count_if(outcomes.begin(), outcomes.end(),
                       [](const HardCaseOutcome& outcome) { return !outcome.holds(); });
}

}  // namespace relight
