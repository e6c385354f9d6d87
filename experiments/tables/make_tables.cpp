#include "experiments/tables/make_tables.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/tables/remarks.h"

namespace relight::tables {
namespace {

TableCell error_cell(const Measured& error) {
  return {error.known() ? error_text(error) : "-", 100 * error.value, "", ""};
}

TableCell cost_cell(CostKind cost, double value) { return {cost_text(cost, value), value, "", ""}; }

// "spread" of times: the smallest and largest repeat.
TableCell time_cell(const Measured& ms) {
  TableCell cell = cost_cell(CostKind::relight, ms.value);
  if (ms.known() && ms.low < ms.high)
    cell.text += fmt::format(" ({} … {})", cost_text(CostKind::relight, ms.low),
                             cost_text(CostKind::relight, ms.high));
  return cell;
}

// A method's own run at a limit: what is compared first, then what it took.
TableCell limit_cell(const Results& results, const Group& group, const Cell& cell, ErrorKind error,
                     CostKind cost, bool by_error) {
  if (!cell.point) return {"failed or not run", TableCell{}.value, "soft", ""};
  const Point& p = group.points[*cell.point];
  const std::string link = p.record < results.links.size() ? results.links[p.record] : "";
  const std::string label = p.label.empty() ? "" : fmt::format(" · {}", p.label);
  const Measured& e = p[error];
  const double value = by_error ? p[cost].value : 100 * e.value;
  const std::string costs = cost_text(cost, p[cost].value);
  if (cell.place == Cell::Place::within)
    return {by_error ? fmt::format("{} · {}{}", costs, error_text(e), label)
                     : fmt::format("{} · {}{}", error_text(e), costs, label),
            value, "", link};
  if (cell.place == Cell::Place::perhaps)
    return {fmt::format("perhaps: {} · {}{}", costs, error_text(e), label), value, "soft", link};
  return {
      by_error ? fmt::format("not reached: {} at best", error_text(e)) : fmt::format("{} at least", costs),
      TableCell{}.value, "soft", link};
}

Table limit_table(const Results& results, const Group& group, const LimitTable& limits, bool by_error) {
  const ErrorKind error = limits.error;
  const CostKind cost = limits.cost;
  Table table;
  table.name = plain_name(
      fmt::format("{}_{}_{}_{}", group.title(), by_error ? "equal_error" : "equal", key(cost), key(error)));
  table.title = by_error
                    ? fmt::format("{}: cheapest {} at equal {}", group.title(), title(cost), title(error))
                    : fmt::format("{}: smallest {} at equal {}", group.title(), title(error), title(cost));
  table.columns.push_back({by_error ? title(error) : title(cost), true});
  for (const std::string& method : limits.methods) table.columns.push_back({method, false});
  table.columns.push_back({by_error ? "cheapest" : "smallest error", false});
  for (const LimitRow& row : limits.rows) {
    const std::string limit = by_error ? error_text(row.limit) : cost_text(cost, row.limit);
    std::vector<TableCell> cells{{"≤ " + limit, by_error ? 100 * row.limit : row.limit, "", ""}};
    for (size_t m = 0; m < row.cells.size(); ++m) {
      cells.push_back(limit_cell(results, group, row.cells[m], error, cost, by_error));
      const bool wins = row.verdict.kind == Verdict::Kind::winner || row.verdict.kind == Verdict::Kind::only;
      if (wins && row.verdict.methods.front() == limits.methods[m]) cells.back().style = "best";
    }
    cells.push_back(text_cell(row.verdict.words()));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::vector<TableCell> run_row(const Results& results, const Group& group, const Point& p) {
  const RunRecord& r = results.records[p.record];
  const std::string link = p.record < results.links.size() ? results.links[p.record] : "";
  std::vector<TableCell> row{text_cell(r.scene),
                             text_cell(r.lighting),
                             text_cell(r.view),
                             text_cell(r.method),
                             {p.label.empty() ? "run" : p.label, TableCell{}.value, "", link}};
  for (const ErrorKind e : all_errors) row.push_back(error_cell(p[e]));
  const double floor = floor_of(r, ErrorKind::relative);
  row.push_back({error_text(Measured{floor, floor, floor}), 100 * floor, "", ""});
  if (!r.errors) row.back().text = "-";
  row.push_back(r.errors ? TableCell{fmt::format("{:+.2f} %", 100 * r.errors->value.bias),
                                     100 * r.errors->value.bias, "", ""}
                         : text_cell("-"));
  row.push_back(time_cell(p[CostKind::relight]));
  row.push_back(cost_cell(CostKind::precompute, p[CostKind::precompute].value));
  row.push_back(cost_cell(CostKind::memory, p[CostKind::memory].value));
  row.push_back(text_cell(fmt::format("{}", fmt::join(remarks(p, r, group), "; "))));
  if (!p.failure.empty())
    for (TableCell& cell : row) cell.style = "failed";
  return row;
}

}  // namespace

std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  return name;
}

Table equal_cost_table(const Results& results, const Group& group, ErrorKind error, CostKind cost) {
  return limit_table(results, group, at_equal_cost(group, error, cost), false);
}

Table equal_error_table(const Results& results, const Group& group, ErrorKind error, CostKind cost) {
  return limit_table(results, group, at_equal_error(group, error, cost), true);
}

Table runs_table(const Results& results) {
  Table table{"runs", "All runs", {}, {}, ""};
  for (const char* name : {"scene", "lights", "view", "method", "run"})
    table.columns.push_back({name, false});
  for (const char* name : {"relative %", "edges out %", "indirect %", "noise floor %", "bias %",
                           "relight (ms)", "precompute (s)", "memory (bytes)"})
    table.columns.push_back({name, true});
  table.columns.push_back({"remarks", false});
  for (const Group& group : results.groups)
    for (const Point& p : group.points) table.rows.push_back(run_row(results, group, p));
  table.note =
      "Errors with the half width of their 95 % interval, which holds the noise of the reference alone; "
      "relight "
      "time: median, smallest and largest repeat. 1 MB = 10^6 bytes.";
  return table;
}

Table failures_table(const Results& results) {
  Table table{"failures", "What failed, and why", {}, {}, ""};
  for (const char* name : {"scene", "lights", "method", "run", "why"}) table.columns.push_back({name, false});
  for (const Group& group : results.groups)
    for (const Point& p : group.points)
      if (!p.failure.empty())
        table.rows.push_back({text_cell(group.scene), text_cell(group.lighting), text_cell(p.method),
                              text_cell(p.label), text_cell(p.failure)});
  return table;
}

}  // namespace relight::tables
