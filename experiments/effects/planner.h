// The parts that planning and checking share: a method's effects under a request, and a pilot on a view.
#pragma once

#include <optional>

#include "experiments/effects/loss_of_levels.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/effects/scene_facts.h"

namespace relight {

// The effects of a request that can be planned, and those that the user's own knobs fix.
struct PlannableEffects {
  std::vector<Effect> effects;
  std::vector<EffectDecision> fixed;
};
PlannableEffects plannable_effects(const EffectRequest& request);

// Number of the level; UsageError listing the valid ones.
size_t find_level(const Effect& effect, const std::string& level);

// The pilot that measures these effects: everything's paths, and longer ones, by which it is seen what even
// everything lacks.
Pilot make_pilot(const EffectSite& site, EffectPaths& paths, int samples, uint64_t seed, Progress& progress);

// What the scene makes certain.
struct Rule {
  size_t level = 0;    // lowest that loses nothing
  std::string reason;  // empty: the rule lowers nothing
};
// Of effect e with the other effects at `levels`.
Rule rule_for(size_t e, const std::vector<Effect>& effects, const EffectPaths& paths, const Levels& levels,
              const EffectSite& site, const SceneFacts& facts);

}  // namespace relight
