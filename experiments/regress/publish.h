// `relight publish`: keeps the results of an experiment in a small form that can be committed.
#pragma once

#include <filesystem>
#include <string>

#include "common/run/run_record.h"

namespace relight {

// The record as a line with what a regression, a table or a figure needs: numbers with seven digits, without
// warnings and command (both name folders of the machine; the knobs are all there).
std::string published_line(const RunRecord& record);

// Writes TO/records.jsonl, one line a run, the latest of each, TO/table.csv, and TO/waterfalls/RUN.csv for
// each run whose error was taken apart; replaces what was there. Returns what should be known before
// committing: failed runs, builds that are no commit. UsageError if FROM has no records, Error if TO cannot
// be written.
std::string publish(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace relight
