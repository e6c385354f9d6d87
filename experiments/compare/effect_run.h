// The effect planner within a comparison: plans before a method runs, checks afterwards.
#pragma once

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"
#include "experiments/compare/run_method.h"
#include "experiments/session/session.h"

namespace relight {

// Plans the effects of `method` on the session and sets its knobs and light paths accordingly.
EffectPlan plan_and_apply(const EffectPlanning& planning, MethodPlan& method, Session& session);

// Measures what the plan lost, by `samples` paths a pixel, and with planning.check runs the method with
// everything on beside `run`, which must not have used the artefact cache either. A broken promise becomes a
// warning of the record.
void check_plan(const EffectPlanning& planning, const MethodPlan& asked, const MethodRun& run, int samples,
                int repeats, Session& session, RunRecord& record);

}  // namespace relight
