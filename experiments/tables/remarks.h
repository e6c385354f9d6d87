// What a reader should know of a run before believing its numbers, in words.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/points.h"

namespace relight::tables {

// Failures; a picture that is darker or brighter than the reference by 1 % or more, noise apart; an error
// that the reference's noise could explain alone; the run of the group that is as exact and the most times
// faster, if that is at least twice; precompute times that are not the run's own.
std::vector<std::string> remarks(const Point& point, const RunRecord& record, const Group& group);

}  // namespace relight::tables
