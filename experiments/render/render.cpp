#include "experiments/render/render.h"

#include "experiments/compare/effect_run.h"
#include "experiments/compare/not_simulated.h"
#include "experiments/compare/run_method.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/render/picture.h"
#include "experiments/usage_error.h"

namespace relight {

std::string render(const RenderOptions& options, const MethodList& methods) {
  const Method& method = find_method(methods, options.method);
  require_preset(options.preset, {&method});
  const auto planning = plan_effect_options(options.effects, {&method});
  MethodPlan plan = plan_method(method, parse_settings(options.settings, {&method}), options.preset);
  check_picture_options(options);
  Session session(options.session, Session::Gpu::needed);
  std::string effects;
  if (planning) effects = effect_plan_text(plan_and_apply(*planning, plan, session));
  const MethodRun run = run_method(plan, session, 1);
  if (!run.failure.empty()) fail("{} failed: {}", method.name(), run.failure);
  write_picture(options.out, run.relit, options.image, session.scene().exposure,
                {{"relight.method", method.name()}, {"relight.image", options.image}});
  return effects +
         fmt::format(
             "{}: precompute {:.2f} s, relight {:.1f} ms, carries {}\nnot simulated: {}\nimage   {}\n",
             method.name(), run.precompute_s, run.relight_ms.front(), plan.paths.to_string(),
             fmt::join(not_simulated(plan.paths, session.scene(), session.lighting()), "; "), options.out);
}

}  // namespace relight
