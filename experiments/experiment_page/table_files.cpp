// The tables as files for papers and programs.
#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "experiments/experiment_page/page_parts.h"
#include "experiments/tables/sequences.h"
#include "experiments/tables/winners.h"

namespace relight::page {
namespace {

using namespace tables;

// Markdown and LaTeX hold what a paper prints: the relative error, at equal time, memory and error. JSON
// holds every choice of the page.
std::vector<Table> main_tables(const Results& results) {
  std::vector<Table> list;
  for (const Group& group : results.groups) {
    list.push_back(equal_cost_table(results, group, ErrorKind::relative, CostKind::relight));
    list.push_back(equal_cost_table(results, group, ErrorKind::relative, CostKind::memory));
    list.push_back(equal_error_table(results, group, ErrorKind::relative, CostKind::relight));
  }
  std::erase_if(list, [](const Table& t) { return t.rows.empty(); });
  return list;
}

std::vector<Table> every_table(const Results& results) {
  std::vector<Table> list;
  for (const Group& group : results.groups)
    for (const ErrorKind error : all_errors)
      for (const CostKind cost : all_costs) {
        list.push_back(equal_cost_table(results, group, error, cost));
        list.push_back(equal_error_table(results, group, error, cost));
      }
  std::erase_if(list, [](const Table& t) { return t.rows.empty(); });
  return list;
}

}  // namespace

void write_table_files(const std::filesystem::path& folder, const ExperimentDescription& description,
                       const Results& results, const std::vector<Table>& more) {
  std::vector<Table> shown = main_tables(results), all = every_table(results);
  shown.push_back(runs_table(results)), all.push_back(runs_table(results));
  if (const Table moving = sequence_table(results); !moving.rows.empty())
    shown.push_back(moving), all.push_back(moving);
  for (const Table& table : more) shown.push_back(table), all.push_back(table);
  std::string md = fmt::format("# {}\n\n", description.title), tex, js;
  for (const std::string& sentence : who_wins(results.groups)) md += sentence + "\n\n";
  for (const Table& table : shown) md += markdown(table) + "\n", tex += latex(table) + "\n";
  for (const Table& table : all) js += (js.empty() ? "" : ",\n") + json_text(table);
  write_text_atomically(folder / "tables.md", md);
  write_text_atomically(folder / "tables.tex", "% needs \\usepackage{booktabs} and UTF-8\n" + tex);
  write_text_atomically(folder / "table.json", "[" + js + "]\n");
}

}  // namespace relight::page
