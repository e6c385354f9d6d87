// From lists to runs: the product, checked before anything starts.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <tuple>

#include "common/lights/light_animation.h"
#include "common/run/error.h"
#include "experiments/options/parse.h"
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

// What tells the run from all others on its scene and lights: every knob that the file sets; `view` if there
// are several.
std::string label(const RunGroup& group, const std::string& preset, const std::string& tolerance,
                  const std::string& seed, const std::vector<KnobSetting>& settings,
                  const std::string& view) {
  std::string text = preset;
  if (!tolerance.empty()) text += fmt::format(" tolerance={}", tolerance);
  for (const KnobSetting& s : settings) text += fmt::format(" {}={}", s.knob, s.value);
  if (group.seeds.size() > 1) text += fmt::format(" seed={}", seed);
  if (!view.empty()) text += fmt::format(" view={}", view);
  return text;
}

// Every preset with every tolerance.
std::vector<std::pair<std::string, std::string>> with_tolerances(const RunGroup& group) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& preset : group.presets)
    for (const std::string& tolerance : group.tolerances) pairs.emplace_back(preset, tolerance);
  return pairs;
}

// Scenes without their geometry: what lightings and views they have.
class Places {
 public:
  // Why the scene cannot be used, or nothing.
  std::string problem(const std::string& scene) {
    load(scene);
    return problems_[scene];
  }
  std::string hash(const std::string& scene) {
    return fmt::format("{:016x}", shells_.at(scene).content_hash);
  }
  // Its name as records have it, and its hash. UsageError if the scene has no such lighting.
  std::pair<std::string, std::string> lighting(const std::string& scene, const std::string& lights) {
    load(scene);
    const ChosenLighting chosen = choose_lights(shells_.at(scene), lights);
    return {chosen.name, lighting_hash(lighting_at(chosen.animated, chosen.time))};
  }
  std::string view_hash(const std::string& scene, const std::string& view) {
    load(scene);
    return relight::view_hash(choose_view(shells_.at(scene), view));
  }

 private:
  void load(const std::string& name) {
    if (problems_.count(name)) return;
    problems_[name] = "";
    try {
      Scene scene = load_named_scene(name);
      Scene& shell = shells_[name];
      shell.name = scene.name, shell.content_hash = scene.content_hash;
      shell.camera = scene.camera, shell.views = std::move(scene.views);
      shell.lightings = std::move(scene.lightings);
    } catch (const std::exception& error) {
      problems_[name] = error.what();
    }
  }
  std::map<std::string, std::string> problems_;
  std::map<std::string, Scene> shells_;
};

// Runs on one scene, view and lighting follow each other, among them those that share prepared data: these
// are then loaded from the cache while it is warm, and timed by turns.
void order(std::vector<PlannedRun>& runs) {
  std::map<std::string, size_t> first_use;
  const auto data = [&](const PlannedRun& r) {
    const MethodPlan& method = r.plan.methods.front();
    return first_use.try_emplace(method.method->name() + method.knobs.precompute_key(), first_use.size())
        .first->second;
  };
  for (const PlannedRun& run : runs) data(run);
  const auto place = [&](const PlannedRun& r) {
    const SessionOptions& s = r.plan.session;
    return std::tuple(s.scene, s.view, s.lights, s.seed, data(r));
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const PlannedRun& a, const PlannedRun& b) { return place(a) < place(b); });
}

}  // namespace

namespace {

// Of a file its name without folder and ending; a name keeps the numbers after its dots ("sweep@0.5").
std::string short_name(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(name).filename();
  const std::string ending = path.extension().string();
  const bool of_a_file = ending.size() > 1 && std::isalpha(static_cast<unsigned char>(ending[1]));
  return of_a_file ? path.stem().string() : path.string();
}

}  // namespace

std::string describe(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  return fmt::format("{}, {}, {}, {}", s.scene, s.lights, run.plan.methods.front().method->name(), run.label);
}

std::string folder_name(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  std::string name = fmt::format("{}_{}_{}_{}", short_name(s.scene), short_name(s.lights),
                                 run.plan.methods.front().method->name(), run.label);
  for (char& c : name)
    if (c == ' ' || c == '/' || c == ':') c = '_';
  return name;
}

namespace {

// One (scene, lighting, view) of a group.
struct Place {
  std::string scene, lights, view, scene_hash, lighting_hash, view_hash;
  bool view_in_label = false;
};

void add_runs(const Experiment& experiment, const RunGroup& group, const Method& method, const Place& place,
              const SessionOptions& base, const std::filesystem::path& out, std::vector<PlannedRun>& runs) {
  for (const std::string& seed : group.seeds)
    for (const auto& [preset, tolerance] : with_tolerances(group))
      for (const std::vector<KnobSetting>& settings : knob_products(group)) {
        ComparePlan plan;
        plan.session = base;
        plan.session.scene = place.scene;
        plan.session.lights = place.lights;
        plan.session.view = place.view;
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
        runs.push_back(
            {std::move(plan),
             label(group, preset, tolerance, seed, settings, place.view_in_label ? place.view : ""),
             place.scene_hash, place.view_hash, place.lighting_hash, group.explain_pixels});
      }
}

bool several_views(const Experiment& experiment) {
  std::set<std::string> views;
  for (const RunGroup& group : experiment.groups) views.insert(group.views.begin(), group.views.end());
  return views.size() > 1;
}

}  // namespace

RunList make_runs(const Experiment& experiment, const SessionOptions& base, const MethodList& methods,
                  const std::filesystem::path& out) {
  RunList list;
  Places places;
  const bool view_in_label = several_views(experiment);
  for (const RunGroup& group : experiment.groups) {
    for (const std::string& view : group.views) parse_view(view);
    const Method& method = find_method(methods, group.method);
    for (const std::string& preset : group.presets) require_preset(preset, {&method});
    for (const std::string& scene : group.scenes) {
      if (const std::string problem = places.problem(scene); !problem.empty()) {
        if (!group.optional) fail("{}", problem);
        list.left_out.push_back(fmt::format("{}: not on this machine ({})", scene, problem));
        continue;
      }
      for (const std::string& view : group.views)
        for (const std::string& lights : group.lights) {
          const auto [lighting, lighting_hash] = places.lighting(scene, lights);
          add_runs(experiment, group, method,
                   {scene, lighting, to_string(parse_view(view)), places.hash(scene), lighting_hash,
                    places.view_hash(scene, view), view_in_label},
                   base, out, list.runs);
        }
    }
  }
  order(list.runs);
  return list;
}

}  // namespace relight
