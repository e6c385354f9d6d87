// The parts of the page of an experiment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment_page/experiment_page.h"
#include "experiments/tables/make_tables.h"

namespace relight::page {

using tables::Results;
using tables::Table;

// Name and title are the folder's name if the file is missing; Error if it is broken.
ExperimentDescription read_description(const std::filesystem::path& folder);

// Where the pictures of a run are; empty: it has none.
struct RunFolder {
  std::filesystem::path path;
  std::string link;  // address of its page, relative to the experiment's
};

// Writes the pages of runs; by record. A run's folder is known by the command in the header of its images.
std::vector<RunFolder> write_run_pages(const std::filesystem::path& folder,
                                       const std::vector<RunRecord>& records, RunPages run_pages);

// table.json, tables.md and tables.tex.
void write_table_files(const std::filesystem::path& folder, const ExperimentDescription& description,
                       const Results& results, const std::vector<Table>& more);

// With sorting by click and its CSV; script.cpp makes both work.
std::string html(const Table& table);

std::string who_wins_section(const Results& results);
// Choice of error and cost, legend, and for each group plot and tables.
std::string accuracy_section(const Results& results);
// What the methods leave out, and what the effect planner decided.
std::string left_out_section(const Results& results, const std::vector<std::string>& scenes);
// What `relight explain-error` left in the folders of the runs (waterfall.json), one row a stage; empty
// without any. A file that cannot be read is a warning.
Table explained_table(const Results& results, const std::vector<RunFolder>& folders,
                      std::vector<std::string>& warnings);
std::string explained_section(const Table& explained);
std::string provenance_section(const Results& results, const std::vector<std::string>& warnings);

// Points, fronts and floors for script.cpp, as JSON.
std::string plot_data(const Results& results);

extern const char* const style_sheet;
extern const char* const table_script;
extern const char* const plot_script;

}  // namespace relight::page
