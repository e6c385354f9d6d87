// Changes of the errors of total and indirect image.
#pragma once

#include <vector>

#include "experiments/regress/changes.h"

namespace relight {

// An error has changed if it moved by more than the 95 % half widths of both records together; smaller moves
// are notes (the same build gives the same bits, so they too have a cause). `factor` > 0: pictures of a time
// budget, whose errors change with every run: only `relative` is compared, and may grow by that factor.
void compare_errors(const RunRecord& published, const RunRecord& fresh, double factor,
                    std::vector<Change>& out);

}  // namespace relight
