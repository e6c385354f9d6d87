#include "experiments/tables/equal.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace relight::tables {
namespace {

// Smallest by `less` among the method's comparable points that `fits` accepts.
template <class Fits, class Less>
std::optional<size_t> best(const Group& group, const std::string& method, ErrorKind error, CostKind cost,
                           const Fits& fits, const Less& less) {
  std::optional<size_t> found;
  for (size_t i = 0; i < group.points.size(); ++i) {
    const Point& p = group.points[i];
    if (p.method != method || !p.comparable(error, cost) || !fits(p)) continue;
    if (!found || less(p, group.points[*found])) found = i;
  }
  return found;
}

// Judges the cells by `measure`, of which less is better. `perhaps` cells can spoil a victory, not win.
template <class Measure>
Verdict judge(const Group& group, const LimitRow& row, const std::vector<std::string>& methods,
              const Measure& measure) {
  const auto value = [&](size_t m) -> const Measured& { return measure(group.points[*row.cells[m].point]); };
  std::optional<size_t> first;
  size_t candidates = 0;
  for (size_t m = 0; m < methods.size(); ++m) {
    if (row.cells[m].place == Cell::Place::outside) continue;
    ++candidates;
    if (row.cells[m].place == Cell::Place::within && (!first || value(m).value < value(*first).value))
      first = m;
  }
  if (!first) return {};
  Verdict verdict{Verdict::Kind::winner, {methods[*first]}};
  if (candidates == 1) verdict.kind = Verdict::Kind::only;
  for (size_t m = 0; m < methods.size(); ++m) {
    if (m == *first || row.cells[m].place == Cell::Place::outside) continue;
    const bool may_be_better =
        row.cells[m].place == Cell::Place::perhaps && value(m).low <= value(*first).high;
    if (!may_be_better && !overlap(value(m), value(*first))) continue;
    verdict.kind = Verdict::Kind::tie;
    verdict.methods.push_back(methods[m]);
  }
  return verdict;
}

// Round numbers 10^k x `steps` from the first that holds the smallest value to the first that holds the
// largest.
std::vector<double> round_limits(std::vector<double> values, const std::vector<double>& steps) {
  std::sort(values.begin(), values.end());
  std::vector<double> positive;
  std::copy_if(values.begin(), values.end(), std::back_inserter(positive), [](double v) { return v > 0; });
  if (positive.empty()) return {};
  std::vector<double> limits;
  const int first = static_cast<int>(std::floor(std::log10(positive.front()))) - 1;
  for (int decade = first; limits.empty() || limits.back() < positive.back(); ++decade)
    for (const double step : steps) {
      const double limit = step * std::pow(10.0, decade);
      if (!limits.empty() && limits.back() >= positive.back()) break;
      limits.push_back(limit);
    }
  // Below the smallest only what costs nothing fits; then the last such limit is worth a row.
  const auto holds = std::lower_bound(limits.begin(), limits.end(), positive.front());
  const bool free = positive.size() < values.size() && holds != limits.begin();
  limits.erase(limits.begin(), free ? holds - 1 : holds);
  return limits;
}

template <class Row>
LimitTable with_limits(const Group& group, ErrorKind error, CostKind cost, const std::vector<double>& limits,
                       const Row& row_at) {
  LimitTable table{error, cost, group.methods(), {}};
  for (const double limit : limits) {
    LimitRow row = row_at(group, error, cost, limit);
    if (row.verdict.kind == Verdict::Kind::nobody) continue;
    if (!table.rows.empty() && table.rows.back().cells == row.cells &&
        table.rows.back().verdict == row.verdict)
      continue;
    table.rows.push_back(std::move(row));
  }
  return table;
}

template <class Pick>
std::vector<double> values(const Group& group, ErrorKind error, CostKind cost, const Pick& pick) {
  std::vector<double> all;
  for (const Point& p : group.points)
    if (p.comparable(error, cost)) all.push_back(pick(p));
  return all;
}

}  // namespace

std::string Verdict::words() const {
  switch (kind) {
    case Kind::nobody:
      return "nobody";
    case Kind::only:
      return "only " + methods.front();
    case Kind::winner:
      return methods.front();
    case Kind::tie:
      return fmt::format("tie: {}", fmt::join(methods, ", "));
  }
  return "";
}

LimitRow row_at_cost(const Group& group, ErrorKind error, CostKind cost, double limit) {
  const std::vector<std::string> methods = group.methods();
  const auto less_error = [&](const Point& a, const Point& b) { return a[error].value < b[error].value; };
  const auto cheaper = [&](const Point& a, const Point& b) { return a[cost].value < b[cost].value; };
  LimitRow row{limit, {}, {}};
  for (const std::string& method : methods) {
    const auto fits = [&](const Point& p) { return p[cost].value <= limit; };
    const auto within = best(group, method, error, cost, fits, less_error);
    const auto nearest = best(
        group, method, error, cost, [](const Point&) { return true; }, cheaper);
    row.cells.push_back(within ? Cell{within, Cell::Place::within} : Cell{nearest, Cell::Place::outside});
  }
  row.verdict = judge(group, row, methods, [&](const Point& p) -> const Measured& { return p[error]; });
  return row;
}

LimitRow row_at_error(const Group& group, ErrorKind error, CostKind cost, double limit) {
  const std::vector<std::string> methods = group.methods();
  const auto less_error = [&](const Point& a, const Point& b) { return a[error].value < b[error].value; };
  const auto cheaper = [&](const Point& a, const Point& b) { return a[cost].value < b[cost].value; };
  LimitRow row{limit, {}, {}};
  for (const std::string& method : methods) {
    const auto within = best(
        group, method, error, cost, [&](const Point& p) { return p[error].high <= limit; }, cheaper);
    const auto perhaps = best(
        group, method, error, cost, [&](const Point& p) { return p[error].low <= limit; }, cheaper);
    const auto nearest = best(
        group, method, error, cost, [](const Point&) { return true; }, less_error);
    row.cells.push_back(within    ? Cell{within, Cell::Place::within}
                        : perhaps ? Cell{perhaps, Cell::Place::perhaps}
                                  : Cell{nearest, Cell::Place::outside});
  }
  row.verdict = judge(group, row, methods, [&](const Point& p) -> const Measured& { return p[cost]; });
  return row;
}

LimitTable at_equal_cost(const Group& group, ErrorKind error, CostKind cost) {
  const auto costs = values(group, error, cost, [&](const Point& p) { return p[cost].value; });
  return with_limits(group, error, cost, round_limits(costs, {1, 3}), row_at_cost);
}

LimitTable at_equal_error(const Group& group, ErrorKind error, CostKind cost) {
  const auto errors = values(group, error, cost, [&](const Point& p) { return p[error].high; });
  return with_limits(group, error, cost, round_limits(errors, {1, 2, 5}), row_at_error);
}

}  // namespace relight::tables
