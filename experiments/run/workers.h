// `relight run --jobs N`: the program starts itself, once for each scene and lighting, N at a time.
#pragma once

#include <string>
#include <vector>

#include "experiments/run/run_experiment.h"

namespace relight {

// The numbers of the places (scene, lighting and seed) of the runs, counted from 0 in the list's order; one
// entry a run.
std::vector<size_t> place_numbers(const RunList& list);

size_t number_of_places(const RunList& list);

// The words, after the program's name, that make it a worker for one place. It gets its share of the cores
// unless the number of threads was given.
std::vector<std::string> worker_command(const RunOptions& options, const std::filesystem::path& out,
                                        size_t place);

// Starts this program with each of `commands` (words after its name), at most `jobs` at a time, and waits for
// all. Returns those that did not exit with 0 or 1 (which says that a run failed; its record tells which).
// Processes end with this one, also if it is killed.
std::vector<std::string> run_workers(const std::vector<std::vector<std::string>>& commands, int jobs);

}  // namespace relight
