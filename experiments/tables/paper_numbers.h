// The figures of a paper beside those of a run, with a verdict in plain words. The figures are data:
// experiments/paper_numbers/*.toml; format: docs/experiments.md.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/tables/csv_rows.h"
#include "experiments/tables/table.h"

namespace relight::tables {

struct PaperFigure {
  std::string what, where;     // "final gather"; "table 2"
  double low = 0, high = 0;    // as printed, half of the last digit on both sides
  std::string printed, unit;   // "13.1 to 15.5", "%"
  std::string column;          // of table.csv
  double factor = 1;           // column x factor is in the figure's unit
  std::string half_width;      // column of the half width of ours; empty: exact
  std::string better;          // smaller, larger or neither
  bool of_machine = false;     // depends on the machine
  std::string not_comparable;  // why not, or empty
  std::string remark;
  std::map<std::string, std::string> match;  // column -> value of the runs that it stands beside
};

struct PaperNumbers {
  std::string paper, machine;
  std::vector<PaperFigure> figures;
};

// Throws Error naming file, line, field, value and what is valid.
PaperNumbers read_paper_numbers(const std::filesystem::path& file);

// "better", "worse", "within" (intervals overlap), "less" or "more" where neither is better, or "not
// comparable: ...". `half`: half width of ours; both in the figure's unit.
std::string verdict(const PaperFigure& figure, double ours, double half);

// One row for each figure and each run of table.csv that it stands beside; figures without a run are left
// out.
Table paper_table(const PaperNumbers& numbers, const std::vector<CsvRow>& runs);

}  // namespace relight::tables
