#include <chrono>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "experiments/effects/planner.h"

namespace relight {

namespace {

constexpr uint64_t check_stream = 0x636865636b;
constexpr int replicates = 8;

// Numbers of the levels that the plan names.
Levels planned_levels(const std::vector<Effect>& effects, const EffectPlan& plan) {
  Levels levels;
  for (const Effect& effect : effects)
    for (const EffectDecision& d : plan.effects)
      if (d.effect == effect.name) levels.push_back(find_level(effect, d.level));
  if (levels.size() != effects.size()) fail("effect check: the plan belongs to other effects");
  return levels;
}

EffectVerdict verdict(const LossInterval& measured, double tolerance) {
  if (measured.high <= tolerance) return EffectVerdict::kept;
  return measured.low > tolerance ? EffectVerdict::broken : EffectVerdict::open;
}

}  // namespace

EffectCheck check_effects(const EffectRequest& request, EffectPlan& plan, const EffectSite& site, int samples,
                          Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const PlannableEffects plannable = plannable_effects(request);
  EffectPaths paths(request.method, request.knobs, plannable.effects);
  const Levels everything = paths.everything(), levels = planned_levels(plannable.effects, plan);
  const int a_replicate = std::max(1, (samples + replicates - 1) / replicates);
  Pilot pilot = make_pilot(site, paths, a_replicate, random_bits(request.seed, check_stream, 0, 0), progress);
  pilot.trace(replicates);
  const LossOfLevels loss(plannable.effects, site, pilot.light(), paths, everything);
  for (size_t e = 0; e < plannable.effects.size(); ++e) {
    Levels alone = everything;
    alone[e] = levels[e];
    for (EffectDecision& d : plan.effects)
      if (d.effect == plannable.effects[e].name) d.measured = loss.between(everything, alone);
  }
  EffectCheck check;
  check.measured = loss.between(everything, levels);
  check.verdict = verdict(check.measured, plan.tolerance);
  check.as_predicted = check.measured.low <= plan.loss.high && plan.loss.low <= check.measured.high;
  check.samples = pilot.light().samples;
  if (pilot.light().non_finite > 0)
    plan.warnings.push_back(fmt::format("effect check: {} samples were not finite and were replaced by zero",
                                        pilot.light().non_finite));
  check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return check;
}

}  // namespace relight
