// The effect planner: which effects a method should compute on a scene, lighting and view so that what it
// leaves out stays below a tolerance. Knows no method by name. What it decides and how: docs/effects.md.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/run/effect_plan.h"
#include "common/run/method.h"

namespace relight {

struct EffectRequest {
  const Method& method;
  const KnobValues& knobs;
  std::set<std::string> fixed;  // knobs that the user set: effects that need them are not planned
  double tolerance = 0.01;      // largest share of the picture that may be lost
  std::map<std::string, std::string>
      asked;  // effect -> level, decided by the user; those of other methods too
  uint64_t seed = 1;
};

// Rules first; then a pilot, if they leave a question open, of 8, 16 or 32 independent small traces: as many
// as the decisions take. From everything on, the effect whose next lower level keeps the loss of the whole
// plan least is lowered, again and again, while the upper end of that loss's interval stays within the
// tolerance. Deterministic for a seed, whatever the number of threads. Throws UsageError for a level that an
// effect of the method doesn't have, Error if the method's effects are inconsistent.
EffectPlan plan_effects(const EffectRequest& request, const EffectSite& site, Progress& progress);

// Measures what the plan lost at the site's own view by an independent path trace of `samples` paths a pixel.
EffectCheck check_effects(const EffectRequest& request, EffectPlan& plan, const EffectSite& site, int samples,
                          Progress& progress);

// The knobs of the plan, or with every planned effect at its last level.
KnobValues planned_knobs(const KnobValues& knobs, const EffectPlan& plan);
KnobValues everything_knobs(const EffectRequest& request);

// UsageError listing the valid names if one of `asked` is an effect of none of the methods, or a level that
// one of them doesn't have.
void require_effects(const std::map<std::string, std::string>& asked,
                     const std::vector<const Method*>& methods);

// What was decided, as a table for people; what the check said, if there was one.
std::string effect_plan_text(const EffectPlan& plan);

}  // namespace relight
