#include "experiments/run/experiment.h"

#include "common/run/error.h"
#include "common/scene/files/toml_reader.h"
#include "experiments/explain/explain_plan.h"
#include "experiments/options/parse.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

// A scene file is relative to the experiment's folder; anything else is the name of a built-in scene.
std::string scene_name(const std::string& text, const std::filesystem::path& folder) {
  const std::string name = replace_variables(text, "scenes");
  const std::filesystem::path beside = (folder / name).lexically_normal();
  return name.find('/') != std::string::npos && !std::filesystem::path(name).is_absolute() ? beside.string()
                                                                                           : name;
}

std::vector<std::string> values_or(const TomlTable& table, const std::string& key, const char* fallback) {
  std::vector<std::string> values = table.values(key);
  if (values.empty()) values.push_back(fallback);
  return values;
}

// "sweep@0:1:0.5" is sweep@0, sweep@0.5 and sweep@1.
std::vector<std::string> moments(const std::string& lights, const std::string& where) {
  try {
    const LightsChoice choice = parse_lights(lights);
    if (choice.times.size() < 2) return {lights};
    std::vector<std::string> names;
    for (const double time : choice.times) names.push_back(lights_at(choice.name, time));
    return names;
  } catch (const UsageError& error) {
    fail("{}: {}", where, error.what());
  }
}

// `view` is one, `views` are several.
std::vector<std::string> read_views(const TomlTable& table) {
  const std::string one = table.text("view", "");
  const std::vector<std::string> several = table.values("views");
  if (!one.empty() && !several.empty())
    fail("{}: view and views; one of them is enough", table.where("views"));
  if (!several.empty()) return several;
  return {one.empty() ? "640x480" : one};
}

RunGroup read_group(const TomlTable& table, const std::filesystem::path& folder) {
  for (const char* key : {"scenes", "lights", "method"}) table.require(key);
  RunGroup group;
  for (const std::string& scene : table.values("scenes")) group.scenes.push_back(scene_name(scene, folder));
  for (const std::string& lights : table.values("lights"))
    for (const std::string& moment : moments(lights, table.where("lights"))) group.lights.push_back(moment);
  group.views = table.values("views");
  group.method = table.text("method", "");
  group.presets = values_or(table, "presets", "paper");
  group.seeds = values_or(table, "seeds", "1");
  group.explain_pixels = static_cast<int64_t>(table.number("explain_pixels", 0, {0, most_explained_pixels}));
  group.optional = table.boolean("optional", false);
  const TomlTable knobs = table.table("knobs");
  for (const std::string& knob : knobs.keys()) group.knobs[knob] = knobs.values(knob);
  group.tolerances = values_or(table, "tolerance", "");
  const TomlTable effects = table.table("effects");
  if (group.explain_pixels > 0 && table.has("tolerance"))
    fail("{}: explain_pixels takes runs apart whose knobs are set; it does not go with tolerance",
         table.where("explain_pixels"));
  for (const std::string& effect : effects.keys())
    for (const std::string& level : effects.values(effect))
      group.effects.effects.push_back(effect + "=" + level);
  group.effects.check = table.boolean("check_effects", false);
  table.refuse_unknown_keys();
  return group;
}

}  // namespace

Experiment read_experiment(const std::filesystem::path& file) {
  const TomlTable table = TomlTable::parse_file(file);
  Experiment experiment;
  experiment.name = file.stem().string();
  table.require("title");
  experiment.title = table.text("title", "");
  experiment.views = read_views(table);
  experiment.reference_samples = static_cast<int>(table.number("reference_samples", 128, {8, 16777216}));
  experiment.repeats = static_cast<int>(table.number("repeats", 0, {0, 10000}));
  for (const std::string& numbers : table.values("paper_numbers"))
    experiment.paper_numbers.push_back(file.parent_path() / numbers);
  experiment.time_limit_s = table.number("time_limit_s", 0.0, {0.0, 1e9});
  for (const TomlTable& group : table.tables("runs"))
    experiment.groups.push_back(read_group(group, file.parent_path()));
  for (RunGroup& group : experiment.groups)
    if (group.views.empty()) group.views = experiment.views;
  if (experiment.groups.empty()) fail("{}: no runs; write at least one [[runs]] table", file.string());
  table.refuse_unknown_keys();
  return experiment;
}

}  // namespace relight
