// From what a run did to its record: errors, costs, warnings, and everything needed to run it again.
#pragma once

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"
#include "experiments/compare/reference_images.h"
#include "experiments/compare/run_method.h"
#include "experiments/session/session.h"

namespace relight {

// The record without errors and costs: what was run, where, and the command that repeats it.
RunRecord describe_run(const ComparePlan& plan, const MethodPlan& method, Session& session);

// Adds times, bytes, counters and warnings.
void add_costs(RunRecord& record, const MethodRun& run, const Session& session);

// Adds the errors of total and indirect image against the reference, and what the reference cost. Pixels that
// are not finite become an entry of failed_stages naming image and first pixel.
void add_errors(RunRecord& record, const Relit& relit, const ReferenceImages& reference,
                const Session& session);

}  // namespace relight
