// Who is better at equal cost, and who is cheaper at equal error. Nothing is interpolated: each method is
// represented by one of its own runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/points.h"

namespace relight::tables {

// winner: better than the chosen run of every other method, intervals apart. tie: intervals overlap with the
// best one's. only: no other method has a run within the limit. nobody: none has.
struct Verdict {
  enum class Kind { nobody, only, winner, tie };
  Kind kind = Kind::nobody;
  std::vector<std::string> methods;  // one, or those that tie, the best first
  std::string words() const;         // "only a", "a", "tie: a, b", "nobody"
  bool operator==(const Verdict&) const = default;
};

struct Cell {
  std::optional<size_t> point;  // of the group; nothing: the method has no run to show
  // within: inside the limit for certain. perhaps: the limit lies inside the error's interval. outside: the
  // run nearest to the limit, for information.
  enum class Place { within, perhaps, outside };
  Place place = Place::outside;
  bool operator==(const Cell&) const = default;
};

struct LimitRow {
  double limit = 0;         // ms, bytes, s; or share
  std::vector<Cell> cells;  // by method
  Verdict verdict;
};

// Limits are round numbers over the range of the points; one at which nothing changes against the last is
// left out.
struct LimitTable {
  ErrorKind error;
  CostKind cost;
  std::vector<std::string> methods;
  std::vector<LimitRow> rows;
};

// The run of each method with the smallest error whose cost (for times the median) is at most the limit.
LimitTable at_equal_cost(const Group& group, ErrorKind error, CostKind cost);
// The cheapest run of each method whose error is at most the limit, upper end of the interval included.
LimitTable at_equal_error(const Group& group, ErrorKind error, CostKind cost);

// One row of each.
LimitRow row_at_cost(const Group& group, ErrorKind error, CostKind cost, double limit);
LimitRow row_at_error(const Group& group, ErrorKind error, CostKind cost, double limit);

}  // namespace relight::tables
