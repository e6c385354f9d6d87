// From lists to runs: the product, checked before anything starts.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "common/run/error.h"
#include "experiments/run/experiment.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

// Every choice of one value a knob, as settings.
std::vector<std::vector<KnobSetting>> knob_products(const RunGroup& group) {
  std::vector<std::vector<KnobSetting>> products(1);
  for (const auto& [knob, values] : group.knobs) {
    std::vector<std::vector<KnobSetting>> longer;
    for (const std::vector<KnobSetting>& product : products)
      for (const std::string& value : values) {
        longer.push_back(product);
        longer.back().push_back({group.method, knob, value});
      }
    products = std::move(longer);
  }
  return products;
}

uint64_t parse_seed(const std::string& text) {
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
    usage_fail("seeds: '{}': expected a whole number from 0", text);
  return std::stoull(text);
}

// What tells the run from all others on its scene and lights: every knob that the file sets.
std::string label(const RunGroup& group, const std::string& preset, const std::string& tolerance,
                  const std::string& seed, const std::vector<KnobSetting>& settings) {
  std::string text = preset;
  if (!tolerance.empty()) text += fmt::format(" tolerance={}", tolerance);
  for (const KnobSetting& s : settings) text += fmt::format(" {}={}", s.knob, s.value);
  if (group.seeds.size() > 1) text += fmt::format(" seed={}", seed);
  return text;
}

// Every preset with every tolerance.
std::vector<std::pair<std::string, std::string>> with_tolerances(const RunGroup& group) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& preset : group.presets)
    for (const std::string& tolerance : group.tolerances) pairs.emplace_back(preset, tolerance);
  return pairs;
}

// Presets that the scenes have; empty for a scene that is not on this machine.
class Lightings {
 public:
  // Why the scene cannot be used, or nothing.
  std::string problem(const std::string& scene) {
    load(scene);
    return problems_[scene];
  }
  std::string hash(const std::string& scene) { return hashes_[scene]; }
  void require(const std::string& scene, const std::string& lights) {
    load(scene);
    const std::set<std::string>& names = names_[scene];
    if (names.count(lights) || std::filesystem::is_regular_file(lights)) return;
    std::string valid;
    for (const std::string& name : names) append_name(valid, name);
    usage_fail("lights: scene '{}' has no '{}'; valid: {}, or a file", scene, lights, valid);
  }

 private:
  void load(const std::string& name) {
    if (problems_.count(name)) return;
    problems_[name] = "";
    try {
      const Scene scene = load_named_scene(name);
      hashes_[name] = fmt::format("{:016x}", scene.content_hash);
      for (const auto& [lighting, state] : scene.lightings) names_[name].insert(lighting);
    } catch (const std::exception& error) {
      problems_[name] = error.what();
    }
  }
  std::map<std::string, std::string> problems_, hashes_;
  std::map<std::string, std::set<std::string>> names_;
};

// Runs on one scene and lighting follow each other, among them those that share prepared data: these are then
// loaded from the cache while it is warm, and timed by turns.
void order(std::vector<PlannedRun>& runs) {
  std::map<std::string, size_t> first_use;
  const auto data = [&](const PlannedRun& r) {
    const MethodPlan& method = r.plan.methods.front();
    return first_use.try_emplace(method.method->name() + method.knobs.precompute_key(), first_use.size())
        .first->second;
  };
  for (const PlannedRun& run : runs) data(run);
  const auto place = [&](const PlannedRun& r) {
    return std::tuple(r.plan.session.scene, r.plan.session.lights, r.plan.session.seed, data(r));
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const PlannedRun& a, const PlannedRun& b) { return place(a) < place(b); });
}

}  // namespace

std::string describe(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  return fmt::format("{}, {}, {}, {}", s.scene, s.lights, run.plan.methods.front().method->name(), run.label);
}

std::string folder_name(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  std::string name = fmt::format("{}_{}_{}_{}", std::filesystem::path(s.scene).stem().string(),
                                 std::filesystem::path(s.lights).stem().string(),
                                 run.plan.methods.front().method->name(), run.label);
  for (char& c : name)
    if (c == ' ' || c == '/' || c == ':') c = '_';
  return name;
}

RunList make_runs(const Experiment& experiment, const SessionOptions& base, const MethodList& methods,
                  const std::filesystem::path& out) {
  RunList list;
  Lightings lightings;
  parse_view(experiment.view);
  for (const RunGroup& group : experiment.groups) {
    const Method& method = find_method(methods, group.method);
    for (const std::string& preset : group.presets) require_preset(preset, {&method});
    for (const std::string& scene : group.scenes) {
      if (const std::string problem = lightings.problem(scene); !problem.empty()) {
        if (!group.optional) fail("{}", problem);
        list.left_out.push_back(fmt::format("{}: not on this machine ({})", scene, problem));
        continue;
      }
      for (const std::string& lights : group.lights) {
        lightings.require(scene, lights);
        for (const std::string& seed : group.seeds)
          for (const auto& [preset, tolerance] : with_tolerances(group))
            for (const std::vector<KnobSetting>& settings : knob_products(group)) {
              ComparePlan plan;
              plan.session = base;
              plan.session.scene = scene;
              plan.session.lights = lights;
              plan.session.view = experiment.view;
              plan.session.seed = parse_seed(seed);
              plan.methods.push_back(plan_method(method, settings, preset));
              plan.out = out;
              plan.reference_samples = experiment.reference_samples;
              plan.reference_estimator = Estimator::light_vertex;
              plan.repeats = experiment.repeats;
              plan.time_limit_s = experiment.time_limit_s;
              EffectOptions effects = group.effects;
              effects.tolerance = tolerance;
              plan.effects = plan_effect_options(effects, {&method});
              list.runs.push_back({std::move(plan), label(group, preset, tolerance, seed, settings),
                                   lightings.hash(scene), group.explain_pixels});
            }
      }
    }
  }
  order(list.runs);
  return list;
}

}  // namespace relight
