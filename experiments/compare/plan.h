// What `relight compare` was asked to do: options as typed, and the checked plan made of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/method_list.h"
#include "experiments/options/parse.h"
#include "experiments/session/options.h"

namespace relight {

// What the effect planner is asked for, as typed; docs/effects.md.
struct EffectOptions {
  std::string tolerance;             // "1%" or "0.01"; empty: no planning, knobs decide
  std::vector<std::string> effects;  // "name=level"
  bool check = false;                // run also with everything on
};

struct EffectPlanning {
  double tolerance = 0.01;
  std::map<std::string, std::string> asked;  // effect -> level
  bool check = false;
};

struct CompareOptions {
  SessionOptions session;
  std::string methods;                // comma-separated names
  std::string preset = "paper";       // values of knobs before `settings`
  std::vector<std::string> settings;  // "method.knob=value"
  std::string out;                    // folder
  std::string bounces;                // "a..b"; empty: each method's own
  int reference_samples = 256;        // indirect paths a pixel
  std::string reference_estimator = "light_vertex";
  int repeats = 0;  // timed relights; 0: five, fewer if one takes seconds
  EffectOptions effects;
};

struct MethodPlan {
  const Method* method;
  std::string preset;  // that the knobs started from
  KnobValues knobs;
  LightPaths paths;             // what the method carries under these knobs
  std::set<std::string> fixed;  // knobs that the user set one by one
};

struct ComparePlan {
  SessionOptions session;
  std::vector<MethodPlan> methods;
  std::filesystem::path out;
  std::optional<BounceRange> bounces;
  int reference_samples;
  Estimator reference_estimator;
  int repeats;
  std::optional<EffectPlanning> effects = std::nullopt;  // nothing: knobs decide
  double time_limit_s = 0.0;  // > 0: of a method's own work (effect plan, precompute, relights)
};

// Defaults, then what the preset says where the method has it, then those settings that name the method.
// Throws UsageError (unknown method or knob, value out of range).
MethodPlan plan_method(const Method& method, const std::vector<KnobSetting>& settings,
                       const std::string& preset = "paper");

// UsageError listing the valid names if no method has that preset.
void require_preset(const std::string& preset, const std::vector<const Method*>& methods);

// Nothing if no tolerance was given. Throws UsageError for a tolerance outside [0, 1), for effects without a
// tolerance, and for an effect that none of the methods has.
std::optional<EffectPlanning> plan_effect_options(const EffectOptions& options,
                                                  const std::vector<const Method*>& methods);

// "method.knob=value" for each text; UsageError if one names a method outside `methods`.
std::vector<KnobSetting> parse_settings(const std::vector<std::string>& texts,
                                        const std::vector<const Method*>& methods);

// Checks all that can be checked without loading the scene. `methods` must outlive the plan.
ComparePlan make_plan(const CompareOptions& options, const MethodList& methods);

// The light paths that the reference of a method is restricted to: the method's own, or with --bounces in
// place of its bounces.
LightPaths reference_paths(const ComparePlan& plan, const MethodPlan& method);

// The command line that repeats the run of `method` (or of every method of the plan) with every knob written
// out.
std::string command_line(const ComparePlan& plan, const std::string& lights,
                         const std::vector<MethodPlan>& methods);

}  // namespace relight
