// The tables of an experiment, made from records alone.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/equal.h"
#include "experiments/tables/points.h"
#include "experiments/tables/table.h"

namespace relight::tables {

// Everything that tables and page are made from.
struct Results {
  std::vector<RunRecord> records;
  std::vector<Group> groups;
  std::vector<std::string> links;  // by record: relative address of the run's own page, or nothing
};

// "best error at equal ...", one column a method, and who wins.
Table equal_cost_table(const Results& results, const Group& group, ErrorKind error, CostKind cost);
Table equal_error_table(const Results& results, const Group& group, ErrorKind error, CostKind cost);

// One row a run: errors, costs and remarks.
Table runs_table(const Results& results);

// One row a failed run: what and why.
Table failures_table(const Results& results);

// Who wins, and one short table a group, in plain text.
std::string terminal_text(const std::vector<Group>& groups);

// A name for files and addresses: letters, digits, '_'.
std::string plain_name(const std::string& text);

}  // namespace relight::tables
