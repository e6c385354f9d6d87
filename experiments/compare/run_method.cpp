#include "experiments/compare/run_method.h"

#include "experiments/compare/prepared_run.h"

namespace relight {

MethodRun run_method(const MethodPlan& plan, Session& session, int repeats) {
  return run_method(plan, session, {session.buffer(), session.cache()}, repeats);
}

MethodRun run_method(const MethodPlan& plan, Session& session, const MethodSite& site, int repeats) {
  PreparedRun run(plan, session, site, repeats);
  time_in_rounds({&run});
  return run.finish();
}

}  // namespace relight
