// relight plan
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/compare/effect_run.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/method_list.h"

namespace relight::cli {

namespace {

struct PlanOptions {
  SessionOptions session;
  std::string method, preset = "paper", out;
  std::vector<std::string> settings;
  EffectOptions effects;
};

int run_plan(const PlanOptions& options) {
  const MethodList methods = make_all_methods();
  const Method& method = find_method(methods, options.method);
  require_preset(options.preset, {&method});
  MethodPlan plan = plan_method(method, parse_settings(options.settings, {&method}), options.preset);
  const auto planning = plan_effect_options(options.effects, {&method});
  Session session(options.session, Session::Gpu::not_needed);
  const EffectPlan effects = plan_and_apply(*planning, plan, session);
  fmt::print("{}", effect_plan_text(effects));
  if (!options.out.empty()) {
    write_text_atomically(options.out, effect_plan_to_json(effects) + "\n");
    fmt::print("plan    {}\n", options.out);
  }
  return 0;
}

}  // namespace

void add_plan_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "plan",
      "Which effects a method should compute on a scene, lighting and view so that what it leaves out stays "
      "below a tolerance: rules first, then a small path trace. `compare`, `render` and `run` do the same "
      "with "
      "--tolerance. See docs/effects.md");
  const auto options = std::make_shared<PlanOptions>();
  options->effects.tolerance = "1%";
  add_session_flags(*command, options->session);
  command->add_option("--method", options->method, "Method (see `relight methods`)")
      ->required()
      ->type_name("NAME");
  add_knob_flags(*command, options->preset, options->settings);
  add_effect_flags(*command, options->effects);
  command->add_option("--out", options->out, "File for the plan as JSON")->type_name("FILE");
  command->callback([&action, options] { action = [options] { return run_plan(*options); }; });
}

}  // namespace relight::cli
