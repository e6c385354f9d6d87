#include "experiments/tables/winners.h"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/tables/equal.h"

namespace relight::tables {
namespace {

constexpr ErrorKind error = ErrorKind::relative;
constexpr CostKind cost = CostKind::relight;

// "3.27 % against 8.10 % of b", the closest of the others.
std::string by_how_much(const Group& group, const LimitTable& table, const LimitRow& row) {
  std::string winner, second;
  double winners = 0, seconds = 0;
  for (size_t m = 0; m < table.methods.size(); ++m) {
    if (row.cells[m].place != Cell::Place::within) continue;
    const double value = group.points[*row.cells[m].point][error].value;
    if (table.methods[m] == row.verdict.methods.front())
      winner = table.methods[m], winners = value;
    else if (second.empty() || value < seconds)
      second = table.methods[m], seconds = value;
  }
  return fmt::format(" ({} against {} of {})", error_text(winners), error_text(seconds), second);
}

std::string outcome(const Group& group, const LimitTable& table, const LimitRow& row) {
  return row.verdict.words() +
         (row.verdict.kind == Verdict::Kind::winner ? by_how_much(group, table, row) : "");
}

// Rows with one verdict after the other are told together, with the numbers of the last.
std::string sentence(const Group& group, const LimitTable& table) {
  std::vector<std::string> parts;
  size_t first = 0;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const bool last = i + 1 == table.rows.size();
    if (!last && table.rows[i + 1].verdict == table.rows[i].verdict) continue;
    std::string when = cost_text(cost, table.rows[first].limit);
    if (last)
      when += " or more";
    else if (first < i)
      when += " to " + cost_text(cost, table.rows[i].limit);
    parts.push_back(fmt::format("within {} {}", when, outcome(group, table, table.rows[i])));
    first = i + 1;
  }
  if (parts.empty()) return fmt::format("{}: no run can be compared.", group.title());
  return fmt::format("{}: {}.", group.title(), fmt::join(parts, "; "));
}

}  // namespace

std::vector<std::string> who_wins(const std::vector<Group>& groups) {
  std::map<std::string, int> wins;
  int ties = 0, contests = 0;
  std::vector<std::string> sentences;
  for (const Group& group : groups) {
    const LimitTable table = at_equal_cost(group, error, cost);
    for (const LimitRow& row : table.rows) {
      if (row.verdict.kind == Verdict::Kind::only) continue;
      ++contests;
      if (row.verdict.kind == Verdict::Kind::tie)
        ++ties;
      else
        ++wins[row.verdict.methods.front()];
    }
    sentences.push_back(sentence(group, table));
  }
  std::vector<std::string> counts;
  for (const auto& [method, count] : wins) counts.push_back(fmt::format("{} {}", method, count));
  if (ties > 0) counts.push_back(fmt::format("tie {}", ties));
  if (contests > 0)
    sentences.insert(sentences.begin(),
                     fmt::format("Smallest relative error at equal relight time, in {} comparisons of two or "
                                 "more methods: {}.",
                                 contests, fmt::join(counts, ", ")));
  return sentences;
}

}  // namespace relight::tables
