// Who wins where, in sentences made from the tables.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/points.h"

namespace relight::tables {

// First the count over all groups at equal relight time, then one sentence a group: "colonnade, spot,
// 640x480: within 10 ms only a; within 30 ms or more a (3.27 % against 8.10 % of b)." By the relative error,
// at the limits of at_equal_cost().
std::vector<std::string> who_wins(const std::vector<Group>& groups);

}  // namespace relight::tables
