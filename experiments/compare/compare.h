// `relight compare`: runs every method of a plan, each against the reference restricted to its own light
// paths, and leaves images, records and a page behind.
#pragma once

#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"

namespace relight {

// Writes into plan.out, replacing an earlier comparison's records.jsonl: EXR images (image_files.h),
// records.jsonl (a line as soon as a method is done) and index.html. A method that fails leaves a record with
// failed_stages; the others still run. Throws Error if scene, context or output fails.
std::vector<RunRecord> compare(const ComparePlan& plan);

// The table printed at the end, which light paths were compared, what was left out, failures and warnings.
std::string summary_text(const std::vector<RunRecord>& records);

}  // namespace relight
