// `relight tune`: the cheapest setting of any of the methods that keeps an error under one lighting, and
// whether it does so under lightings that the search did not see.
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/tune/tune_plan.h"
#include "experiments/tune/tune_search.h"

namespace relight {

// Met: the whole 95 % interval is within the bound; not met: all of it is beyond; open: it holds the bound.
enum class BoundVerdict { met, open, not_met };
BoundVerdict error_verdict(const Outcome& outcome, double bound);
std::string to_string(BoundVerdict verdict);

struct Verification {
  std::string lights;
  Outcome outcome;
  BoundVerdict verdict;  // of the error
};

struct TuneResult {
  struct Line {
    std::string method, why;
    std::map<std::string, std::string> changed;  // knobs that differ from the defaults
    Outcome outcome;
    std::string command;
  };
  std::vector<Line> tried;    // all that was measured, in order
  size_t chosen = SIZE_MAX;   // index into tried: the cheapest that keeps the bounds, else the closest
  bool keeps_bounds = false;  // does the chosen one?
  std::vector<std::string> unfinished;  // methods whose search the budget ended
  std::vector<Verification> verified;   // of the chosen one
  std::string scene, lights, view;
  Provenance provenance;
  int64_t met() const;
  bool all_met() const { return met() == static_cast<int64_t>(verified.size()); }
};

// Searches, then verifies. Writes OUT/records.jsonl, a line as soon as a setting is measured, and continues
// from it. Progress with the time left at most on standard error. Throws Error if scene, lights or output
// fail.
TuneResult tune(const TunePlan& plan);

// For a terminal: the settings tried, the best first, the choice, its command and how it did under other
// lights.
std::string tune_text(const TunePlan& plan, const TuneResult& result);
std::string tune_csv(const TunePlan& plan, const TuneResult& result);
std::string tune_json(const TunePlan& plan, const TuneResult& result);
std::string tune_markdown(const TunePlan& plan, const TuneResult& result);

}  // namespace relight
