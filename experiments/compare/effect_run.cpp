#include "experiments/compare/effect_run.h"

#include "common/run/error.h"
#include "experiments/effects/plan_effects.h"

namespace relight {

namespace {

EffectRequest request_for(const EffectPlanning& planning, const MethodPlan& method, const Session& session) {
  return {*method.method,     method.knobs,   method.fixed,
          planning.tolerance, planning.asked, session.options().seed};
}

EffectSite site_of(const Session& session) {
  return {session.scene(), session.tracer(), session.buffer(), session.lighting()};
}

int64_t bytes_of(const MethodRun& run) {
  std::map<std::string, int64_t> bytes = run.precompute.bytes();
  for (const auto& [name, n] : run.relight.bytes()) bytes[name] = n;
  int64_t sum = 0;
  for (const auto& [name, n] : bytes) sum += n;
  return sum;
}

EverythingRun run_everything(const EffectRequest& request, const MethodPlan& asked, const MethodRun& run,
                             int repeats, Session& session) {
  MethodPlan all = asked;
  all.knobs = everything_knobs(request);
  all.paths = all.method->light_paths(all.knobs);
  ArtefactCache unused(session.cache().folder(), false);
  const MethodRun full = run_method(all, session, {session.buffer(), unused}, repeats);
  if (!full.failure.empty()) fail("with everything on: {}", full.failure);
  EverythingRun out;
  out.precompute_s = full.precompute_s, out.planned_precompute_s = run.precompute_s;
  out.relight_ms = summarise_times(full.relight_ms).median;
  out.planned_relight_ms = summarise_times(run.relight_ms).median;
  out.bytes = bytes_of(full), out.planned_bytes = bytes_of(run);
  out.picture_change =
      compare_images(run.relit.total, full.relit.total, {}, {}, session.scene().exposure).value.relative;
  return out;
}

}  // namespace

EffectPlan plan_and_apply(const EffectPlanning& planning, MethodPlan& method, Session& session) {
  const EffectPlan plan =
      plan_effects(request_for(planning, method, session), site_of(session), session.progress());
  method.knobs = planned_knobs(method.knobs, plan);
  method.paths = method.method->light_paths(method.knobs);
  return plan;
}

void check_plan(const EffectPlanning& planning, const MethodPlan& asked, const MethodRun& run, int samples,
                int repeats, Session& session, RunRecord& record) {
  EffectPlan& plan = *record.effect_plan;
  const EffectRequest request = request_for(planning, asked, session);
  plan.check = check_effects(request, plan, site_of(session), samples, session.progress());
  if (planning.check) plan.check->everything = run_everything(request, asked, run, repeats, session);
  if (plan.check->verdict == EffectVerdict::broken)
    plan.warnings.push_back(fmt::format(
        "what the effect plan leaves out is {:.3g} % of the picture [{:.3g} to {:.3g}], more than the "
        "tolerance of {:.3g} %",
        100.0 * plan.check->measured.value, 100.0 * plan.check->measured.low,
        100.0 * plan.check->measured.high, 100.0 * plan.tolerance));
  record.warnings.insert(record.warnings.end(), plan.warnings.begin(), plan.warnings.end());
}

}  // namespace relight
