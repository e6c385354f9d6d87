// Pareto fronts: what nobody beats in both error and cost.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/points.h"

namespace relight::tables {

// Places of the points that no other is at least as good as in both error and cost and better in one, by
// rising cost. Values count, not intervals; points that are equal in both are all on the front. Only points
// of `method` unless it is empty; failed runs and values that are not known never.
std::vector<size_t> pareto_front(const std::vector<Point>& points, ErrorKind error, CostKind cost,
                                 const std::string& method = "");

}  // namespace relight::tables
