// One method on one session: precompute once, relight once to warm up, then relight `repeats` times against
// the clock.
#pragma once

#include <string>
#include <vector>

#include "experiments/compare/plan.h"
#include "experiments/session/session.h"

namespace relight {

struct MethodRun {
  std::string failure;  // "phase: why"; empty if the method ran through
  Relit relit;          // of the last relight
  StageLog precompute;
  StageLog relight;  // of the relight with the median time
  // Wall time of the precompute as it is without the artefact cache: loading and storing are left out, and
  // for data that were found there stands the time that they took when they were made.
  double precompute_s = 0.0;
  std::vector<double> relight_ms;  // wall time of each timed relight
};

// Where a method runs: on all of a session's view, or on what `buffer` asks for.
struct MethodSite {
  const DeepFrameBuffer& buffer;  // of the session's view
  ArtefactCache& cache;
  ArtefactCache* parts = nullptr;  // see PrepareContext
  double time_limit_s = 0.0;       // > 0: precompute and relights fail when together they took longer
  double whole_limit_s = 0.0;      // for the message: the limit as it was asked for
};

// repeats = 0: five, but no more than fit into about 20 s (at least one). What the method throws, and images
// of the wrong size, become `failure`; nothing is thrown.
MethodRun run_method(const MethodPlan& plan, Session& session, int repeats);
MethodRun run_method(const MethodPlan& plan, Session& session, const MethodSite& site, int repeats);

}  // namespace relight
