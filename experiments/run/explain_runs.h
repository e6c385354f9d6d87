// The error of an experiment's runs taken apart (`explain_pixels` of a [[runs]] table), after the runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run/experiment.h"

namespace relight {

// Which runs ask for an explanation and have none of these settings in OUT/<run>/waterfall.json yet; places
// in the list.
std::vector<size_t> runs_to_explain(const RunList& list, const std::filesystem::path& out, bool again);

// Writes OUT/<run>/waterfall.csv and .json for these runs. One that fails is told, and the others go on;
// returns a sentence for each. Throws OutputError if results cannot be written.
std::vector<std::string> explain_runs(const RunList& list, const std::vector<size_t>& places,
                                      const std::filesystem::path& out);

}  // namespace relight
