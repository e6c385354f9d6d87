// What differs between two records of one run, the published one and a fresh one, and whether it matters.
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"

namespace relight {

enum class Weight { note, change };  // a change makes the regression fail

struct Change {
  std::string what;  // "relative", "indirect bias", "count.rays", "relight", "failed", ...
  Weight weight = Weight::change;
  std::string words;  // one line: what it was, what it is, why that is too much
};

struct Tolerances {
  double time = 1.3;  // a time is longer if median and fastest both are by more than this factor
};

// Why the times of the two cannot be compared (another processor, number of threads, build type, or a machine
// that was shared); empty if they can.
std::string why_times_differ(const Provenance& published, const Provenance& fresh);

// Compares, in this order: failures, scene and light paths, errors, counters and bytes, times. Rules:
// docs/regress.md.
std::vector<Change> find_changes(const RunRecord& published, const RunRecord& fresh,
                                 const Tolerances& tolerances);

}  // namespace relight
