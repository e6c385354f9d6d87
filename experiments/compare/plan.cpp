#include "experiments/compare/plan.h"

#include "experiments/effects/plan_effects.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr int max_repeats = 10000;

void add_option(std::string& command, const std::string& option, const std::string& value) {
  command += fmt::format(" {} {}", option, shell_quoted(value));
}

}  // namespace

void require_preset(const std::string& preset, const std::vector<const Method*>& methods) {
  std::string valid = "paper";
  for (const Method* method : methods)
    for (const KnobPreset& p : method->presets()) {
      if (p.name == preset) return;
      append_name(valid, p.name);
    }
  if (preset != "paper") usage_fail("--preset '{}': no method of this run has it; valid: {}", preset, valid);
}

MethodPlan plan_method(const Method& method, const std::vector<KnobSetting>& settings,
                       const std::string& preset) {
  KnobValues knobs(method.knobs());
  for (const KnobPreset& p : method.presets())
    if (p.name == preset)
      for (const auto& [knob, value] : p.values) knobs.set(knob, value);
  std::set<std::string> fixed;
  for (const KnobSetting& setting : settings) {
    if (setting.method != method.name()) continue;
    fixed.insert(setting.knob);
    try {
      knobs.set(setting.knob, setting.value);
    } catch (const Error& error) {
      usage_fail("--set {}.{}={}: {}", setting.method, setting.knob, setting.value, error.what());
    }
  }
  const LightPaths paths = method.light_paths(knobs);
  return {&method, preset, std::move(knobs), paths, std::move(fixed)};
}

std::optional<EffectPlanning> plan_effect_options(const EffectOptions& options,
                                                  const std::vector<const Method*>& methods) {
  if (options.tolerance.empty()) {
    if (!options.effects.empty() || options.check)
      usage_fail("{} needs --tolerance: without one nothing is planned and knobs decide",
                 options.effects.empty() ? "--check-effects" : "--effect");
    return std::nullopt;
  }
  EffectPlanning planning;
  planning.tolerance = parse_share("--tolerance", options.tolerance);
  planning.asked = parse_effects(options.effects);
  planning.check = options.check;
  require_effects(planning.asked, methods);
  return planning;
}

std::vector<KnobSetting> parse_settings(const std::vector<std::string>& texts,
                                        const std::vector<const Method*>& methods) {
  std::vector<KnobSetting> settings;
  for (const std::string& text : texts) {
    settings.push_back(parse_knob_setting(text));
    bool known = false;
    std::string valid;
    for (const Method* method : methods) {
      known = known || method->name() == settings.back().method;
      append_name(valid, method->name());
    }
    if (!known) {
      usage_fail("--set '{}': '{}' is not among the methods of this run; valid: {}", text,
                 settings.back().method, valid);
    }
  }
  return settings;
}

ComparePlan make_plan(const CompareOptions& options, const MethodList& methods) {
  ComparePlan plan;
  plan.session = options.session;
  std::vector<const Method*> chosen;
  for (const std::string& name : parse_name_list("--methods", options.methods)) {
    chosen.push_back(&find_method(methods, name));
  }
  const auto settings = parse_settings(options.settings, chosen);
  require_preset(options.preset, chosen);
  for (const Method* method : chosen) plan.methods.push_back(plan_method(*method, settings, options.preset));
  parse_view(options.session.view);
  if (!options.bounces.empty()) plan.bounces = parse_bounces(options.bounces);
  require_samples("--reference-samples", options.reference_samples);
  if (options.repeats < 0 || options.repeats > max_repeats) {
    usage_fail("--repeats {}: expected 0 (chosen by duration) to {}", options.repeats, max_repeats);
  }
  plan.reference_samples = options.reference_samples;
  plan.reference_estimator = parse_estimator(options.reference_estimator);
  plan.repeats = options.repeats;
  plan.effects = plan_effect_options(options.effects, chosen);
  plan.out = options.out;
  require_writable_folder("--out", plan.out);
  return plan;
}

LightPaths reference_paths(const ComparePlan& plan, const MethodPlan& method) {
  LightPaths paths = method.paths;
  if (plan.bounces) {
    paths.min_bounces = plan.bounces->min;
    paths.max_bounces = plan.bounces->max;
  }
  return paths;
}

std::string command_line(const ComparePlan& plan, const std::string& lights,
                         const std::vector<MethodPlan>& methods) {
  std::string names;
  for (const MethodPlan& method : methods) {
    if (!names.empty()) names += ",";
    names += method.method->name();
  }
  std::string command = "relight compare";
  add_option(command, "--scene", plan.session.scene);
  add_option(command, "--view", plan.session.view);
  add_option(command, "--lights", lights);
  add_option(command, "--methods", names);
  for (const MethodPlan& method : methods) {
    for (const auto& [knob, value] : method.knobs.all()) {
      add_option(command, "--set", fmt::format("{}.{}={}", method.method->name(), knob, value));
    }
  }
  if (plan.bounces) add_option(command, "--bounces", to_string(*plan.bounces));
  add_option(command, "--reference-samples", std::to_string(plan.reference_samples));
  add_option(command, "--reference-estimator", to_string(plan.reference_estimator));
  if (plan.repeats > 0) add_option(command, "--repeats", std::to_string(plan.repeats));
  add_option(command, "--seed", std::to_string(plan.session.seed));
  if (plan.session.threads > 0) add_option(command, "--threads", std::to_string(plan.session.threads));
  add_option(command, "--gpu", plan.session.gpu);
  add_option(command, "--out", plan.out.string());
  return command;
}

}  // namespace relight
