// What an experiment leaves for people: one self-contained page with plots and tables, a page a run with its
// pictures, and the tables as files. Made from the folder of `relight run` alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/points.h"

namespace relight {

// What the records do not say; OUT/experiment.json.
struct ExperimentDescription {
  std::string name, title;
  std::vector<std::string> left_out;                 // scenes that are not on this machine, one sentence each
  std::vector<std::filesystem::path> paper_numbers;  // files of a paper's figures (tables/paper_numbers.h)
};

// Also copies the papers' figures into OUT/paper_numbers, so that the folder is whole; checks them first.
// Throws Error naming the file.
void write_description(const std::filesystem::path& folder, const ExperimentDescription& description);

// Did `relight run` write this folder (it holds experiment.json, or of earlier versions table.csv), rather
// than `relight compare`?
bool is_experiment_folder(const std::filesystem::path& folder);

enum class RunPages { missing, all };  // those that are older than their images, or every one

// Writes into the folder: index.html, table.json, tables.md, tables.tex, and index.html of each run that has
// images. Returns the short form for a terminal. Throws Error if there is no readable record or a file cannot
// be written.
std::string write_experiment_page(const std::filesystem::path& folder, RunPages run_pages);

}  // namespace relight
