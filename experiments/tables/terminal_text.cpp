// The experiment on a terminal: who wins, and one short table a group.
#include <fmt/format.h>

#include "experiments/options/text_table.h"
#include "experiments/tables/make_tables.h"
#include "experiments/tables/winners.h"

namespace relight::tables {
namespace {

std::vector<std::string> terminal_row(const Point& p) {
  std::vector<std::string> row{p.method, p.label + (p.failure.empty() ? "" : " (FAILED)")};
  for (const ErrorKind e : all_errors) row.push_back(p[e].known() ? error_text(p[e].value) : "-");
  for (const CostKind c : all_costs) row.push_back(cost_text(c, p[c].value));
  return row;
}

}  // namespace

std::string terminal_text(const std::vector<Group>& groups) {
  std::string text;
  for (const Group& group : groups) {
    TextTable table(
        {"method", "run", "relative", "edges out", "indirect", "relight", "memory", "precompute"});
    for (const Point& p : group.points) table.add_row(terminal_row(p));
    text += fmt::format("\n== {}, noise floor {} ==\n{}", group.title(),
                        error_text(group.noise_floors[0].value), table.to_string(2));
  }
  text += "\n";
  for (const std::string& sentence : who_wins(groups)) text += sentence + "\n";
  return text;
}

}  // namespace relight::tables
