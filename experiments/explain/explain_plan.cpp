#include "experiments/explain/explain_plan.h"

#include <stdexcept>

#include "experiments/compare/reference_images.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

constexpr int max_repeats = 10000;

glm::ivec2 parse_block(const std::string& text) {
  const size_t x = text.find('x');
  const auto side = [&](const std::string& part) {
    const bool digits =
        !part.empty() && part.size() < 5 && part.find_first_not_of("0123456789") == std::string::npos;
    return digits ? std::stoi(part) : 0;
  };
  const glm::ivec2 size =
      x == std::string::npos ? glm::ivec2(0) : glm::ivec2(side(text.substr(0, x)), side(text.substr(x + 1)));
  if (size.x < 4 || size.y < 4 || size.x % 4 != 0 || size.y % 4 != 0)
    usage_fail("--block '{}': expected WIDTHxHEIGHT in pixels, both multiples of 4, e.g. 4x4 or 16x8", text);
  return size;
}

// Every stage must be something that this method can be set to, and must leave its light paths alone: else
// the reference would be another one.
void check_stages(const MethodPlan& method, const ErrorStages& stages) {
  for (const auto* list : {&stages.stages, &stages.closer})
    for (const ErrorStage& stage : *list) {
      const LightPaths paths = method.method->light_paths(with_overrides(method.knobs, stage));
      if (!same_paths(paths, method.paths))
        throw std::logic_error("error stage '" + stage.name + "' of " + method.method->name() +
                               " changes the light paths");
    }
}

}  // namespace

KnobValues with_overrides(KnobValues knobs, const ErrorStage& stage) {
  try {
    for (const auto& [knob, value] : stage.exact) knobs.set(knob, value);
  } catch (const Error& error) {
    throw std::logic_error("error stage '" + stage.name + "': " + error.what());
  }
  return knobs;
}

ExplainPlan plan_explanation(const SessionOptions& session, MethodPlan method,
                             const std::filesystem::path& out) {
  ExplainPlan plan;
  plan.session = session;
  plan.stages = method.method->error_stages(method.knobs);
  check_stages(method, plan.stages);
  plan.method = std::move(method);
  plan.out = out;
  return plan;
}

ExplainPlan make_explain_plan(const ExplainOptions& options, const MethodList& methods) {
  const Method& method = find_method(methods, options.method);
  const std::vector<const Method*> chosen = {&method};
  require_preset(options.preset, chosen);
  MethodPlan planned = plan_method(method, parse_settings(options.settings, chosen), options.preset);
  parse_view(options.session.view);
  require_samples("--reference-samples", options.reference_samples);
  if (options.pixels < 1 || options.pixels > most_explained_pixels)
    usage_fail("--pixels {}: expected 1 to {}", options.pixels, most_explained_pixels);
  if (options.repeats < 0 || options.repeats > max_repeats)
    usage_fail("--repeats {}: expected 0 (chosen by duration) to {}", options.repeats, max_repeats);
  ExplainPlan plan = plan_explanation(options.session, std::move(planned), options.out);
  plan.pixels = options.pixels;
  plan.block = parse_block(options.block);
  plan.reference_samples = options.reference_samples;
  plan.repeats = options.repeats;
  plan.closer = options.closer;
  require_writable_folder("--out", plan.out);
  return plan;
}

std::string command_line(const ExplainPlan& plan, const std::string& lights) {
  std::string command = "relight explain-error";
  const auto add = [&](const std::string& option, const std::string& value) {
    command += fmt::format(" {} {}", option, shell_quoted(value));
  };
  add("--scene", plan.session.scene);
  add("--view", plan.session.view);
  add("--lights", lights);
  add("--method", plan.method.method->name());
  for (const auto& [knob, value] : plan.method.knobs.all())
    add("--set", fmt::format("{}.{}={}", plan.method.method->name(), knob, value));
  add("--pixels", std::to_string(plan.pixels));
  add("--block", fmt::format("{}x{}", plan.block.x, plan.block.y));
  add("--reference-samples", std::to_string(plan.reference_samples));
  if (plan.repeats > 0) add("--repeats", std::to_string(plan.repeats));
  if (plan.closer) command += " --closer";
  add("--seed", std::to_string(plan.session.seed));
  if (plan.session.threads > 0) add("--threads", std::to_string(plan.session.threads));
  add("--gpu", plan.session.gpu);
  add("--out", plan.out.string());
  return command;
}

}  // namespace relight
