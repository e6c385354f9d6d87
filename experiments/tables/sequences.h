// Light sequences: runs that differ in the moment of a lighting alone, taken together.
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/make_tables.h"

namespace relight::tables {

// One setting of a method over the moments of a lighting that moves.
struct Sequence {
  std::string scene, lighting, view, paths, method, label;  // lighting without its time
  std::vector<double> times;                                // [s], increasing
  std::vector<const Point*> points;                         // of `groups`, in the order of times
  double mean(ErrorKind error) const;                       // NaN if a moment has no such error
  size_t worst(ErrorKind error) const;                      // place of the largest, 0 if none is known
};

// Those of two moments or more, in the order of the groups. Failed runs are left out.
std::vector<Sequence> sequences(const std::vector<Group>& groups);

// One row a sequence: mean and largest error, mean and largest relight time. No rows if there is none.
Table sequence_table(const Results& results);

}  // namespace relight::tables
