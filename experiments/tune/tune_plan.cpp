#include "experiments/tune/tune_plan.h"

#include <algorithm>
#include <cmath>

#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr int max_repeats = 1000;

Cost parse_cost(const std::string& text) {
  for (const Cost cost : {Cost::relight, Cost::memory, Cost::precompute})
    if (to_string(cost) == text) return cost;
  usage_fail("--minimise '{}': valid: relight, memory, precompute", text);
}

ErrorMetric parse_metric(const std::string& text) {
  for (const ErrorMetric metric :
       {ErrorMetric::relative, ErrorMetric::relative_edges_out, ErrorMetric::indirect})
    if (to_string(metric) == text) return metric;
  usage_fail("--metric '{}': valid: relative, relative_edges_out, indirect", text);
}

std::optional<double> parse_bound(const char* option, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) usage_fail("{} {}: expected a number above 0", option, value);
  return value == 0.0 ? std::nullopt : std::optional(value);
}

TuneBounds parse_bounds(const TuneOptions& options) {
  TuneBounds bounds;
  bounds.error = parse_share("--error", options.error);
  if (bounds.error == 0.0)
    usage_fail("--error '{}': no setting has no error; expected a share above 0", options.error);
  bounds.relight_ms = parse_bound("--relight-ms", options.relight_ms);
  bounds.memory_mb = parse_bound("--memory", options.memory_mb);
  bounds.precompute_s = parse_bound("--precompute-s", options.precompute_s);
  bounds.minimise = parse_cost(options.minimise);
  return bounds;
}

std::vector<const Method*> chosen_methods(const TuneOptions& options, const MethodList& methods) {
  std::vector<const Method*> chosen;
  for (const std::string& name : options.methods) {
    const Method* method = &find_method(methods, name);
    if (std::find(chosen.begin(), chosen.end(), method) != chosen.end())
      usage_fail("--method '{}' was given twice", name);
    chosen.push_back(method);
  }
  if (chosen.empty())
    for (const auto& method : methods) chosen.push_back(method.get());
  return chosen;
}

std::string command_of(const TuneOptions& o) {
  std::string command = "relight tune";
  const auto add = [&](const char* option, const std::string& value) {
    command += fmt::format(" {} {}", option, shell_quoted(value));
  };
  add("--scene", o.session.scene);
  if (!o.session.lights.empty()) add("--lights", o.session.lights);
  add("--view", o.session.view);
  add("--error", o.error);
  if (o.relight_ms > 0) add("--relight-ms", fmt::format("{}", o.relight_ms));
  if (o.memory_mb > 0) add("--memory", fmt::format("{}", o.memory_mb));
  if (o.precompute_s > 0) add("--precompute-s", fmt::format("{}", o.precompute_s));
  add("--minimise", o.minimise);
  add("--metric", o.metric);
  for (const std::string& method : o.methods) add("--method", method);
  for (const std::string& setting : o.settings) add("--set", setting);
  if (!o.verify_lights.empty()) add("--verify-lights", o.verify_lights);
  add("--budget-s", fmt::format("{}", o.budget_s));
  add("--runs", std::to_string(o.runs));
  add("--reference-samples", std::to_string(o.reference_samples));
  add("--repeats", std::to_string(o.repeats));
  add("--seed", std::to_string(o.session.seed));
  if (o.session.threads > 0) add("--threads", std::to_string(o.session.threads));
  add("--gpu", o.session.gpu);
  add("--out", o.out);
  return command;
}

}  // namespace

std::string to_string(ErrorMetric metric) {
  return metric == ErrorMetric::relative             ? "relative"
         : metric == ErrorMetric::relative_edges_out ? "relative_edges_out"
                                                     : "indirect";
}

TunePlan make_tune_plan(const TuneOptions& options, const MethodList& methods) {
  TunePlan plan;
  plan.session = options.session;
  plan.bounds = parse_bounds(options);
  plan.metric = parse_metric(options.metric);
  const auto chosen = chosen_methods(options, methods);
  const auto settings = parse_settings(options.settings, chosen);
  for (const Method* method : chosen) {
    plan.starts.push_back({plan_method(*method, settings)});
    for (const KnobPreset& preset : method->presets())
      plan.starts.back().push_back(plan_method(*method, settings, preset.name));
  }
  parse_view(options.session.view);
  if (!options.verify_lights.empty())
    plan.verify_lights = parse_name_list("--verify-lights", options.verify_lights);
  if (!(options.budget_s > 0.0)) usage_fail("--budget-s {}: expected seconds above 0", options.budget_s);
  if (options.runs < 1) usage_fail("--runs {}: expected at least 1", options.runs);
  require_samples("--reference-samples", options.reference_samples);
  if (options.repeats < 0 || options.repeats > max_repeats)
    usage_fail("--repeats {}: expected 0 (chosen by duration) to {}", options.repeats, max_repeats);
  plan.budget_s = options.budget_s, plan.runs = options.runs;
  plan.reference_samples = options.reference_samples, plan.repeats = options.repeats;
  plan.out = options.out;
  require_writable_folder("--out", plan.out);
  plan.command = command_of(options);
  return plan;
}

ComparePlan compare_plan(const TunePlan& plan) {
  return {
      plan.session, {}, plan.out / "chosen", std::nullopt, plan.reference_samples, Estimator::light_vertex,
      plan.repeats};
}

Outcome outcome_of(const RunRecord& record, ErrorMetric metric) {
  Outcome outcome;
  for (const std::string& failure : record.failed_stages)
    outcome.failure += (outcome.failure.empty() ? "" : "; ") + failure;
  const auto& errors = metric == ErrorMetric::indirect ? record.errors_indirect : record.errors;
  if (errors && metric == ErrorMetric::relative_edges_out) {
    outcome.error = errors->value.relative_edges_out,
    outcome.half_width = errors->half_width.relative_edges_out;
  } else if (errors) {
    outcome.error = errors->value.relative, outcome.half_width = errors->half_width.relative;
  }
  outcome.relight_ms = record.relight_ms.median;
  outcome.memory_mb = 1e-6 * static_cast<double>(prepared_bytes(record));
  outcome.precompute_s = record.precompute_s;
  return outcome;
}

}  // namespace relight
