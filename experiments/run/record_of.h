// Which record is of which run.
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/run/experiment.h"

namespace relight {

// A record of exactly this run: scene with its content, view, lighting, method, every knob, seed and
// reference.
bool is_record_of(const RunRecord& record, const PlannedRun& run);

// Scene, lighting, view, method, seed, every knob and the tolerance of the effect planner, in words. Two
// records with the same text are of the same run, done again.
std::string run_words(const RunRecord& record);

// Of records of the same run the last; in the order in which the runs were first done.
std::vector<RunRecord> latest_of_each(const std::vector<RunRecord>& records);

}  // namespace relight
