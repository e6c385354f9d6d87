// An experiment: which runs make a table or a figure. Read from experiments/*.toml; format:
// docs/experiments.md.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/compare/plan.h"

namespace relight {

// One [[runs]] table: the product of its lists.
struct RunGroup {
  std::vector<std::string> scenes;  // built-in names or files
  std::vector<std::string> lights;  // presets of the scenes, or files; "sweep@0", "sweep@0.5" if they move
  std::vector<std::string> views;   // "640x480", "gallery:640x480"
  std::vector<std::string> presets;
  std::vector<std::string> seeds;
  std::string method;
  std::map<std::string, std::vector<std::string>> knobs;  // knob -> values
  std::vector<std::string> tolerances;                    // of the effect planner; "": nothing is planned
  EffectOptions effects;                                  // levels and check; its tolerance is not used
  int64_t explain_pixels = 0;  // > 0: also explain the error of each run on so many pixels
  bool optional = false;       // scenes that are not on this machine are left out, and that is said
};

struct Experiment {
  std::string name;                // file name without .toml
  std::string title;               // one sentence
  std::vector<std::string> views;  // of groups that name none
  int reference_samples = 128;
  int repeats = 0;
  std::vector<std::filesystem::path> paper_numbers;  // files of a paper's figures, to stand beside ours
  double time_limit_s = 0.0;                         // > 0: of a run's own work, see ComparePlan
  std::vector<RunGroup> groups;
};

// Throws Error naming file, line, field, value and what is valid. Names of scenes, methods and knobs are
// checked by make_runs().
Experiment read_experiment(const std::filesystem::path& file);

// One run of the expanded product.
struct PlannedRun {
  ComparePlan plan;        // of one method; session.scene, lights, seed, view set
  std::string label;       // for people and folder names: preset, knobs that the file sets, seed, view
  std::string scene_hash;  // content hash of the scene
  std::string view_hash, lighting_hash;
  int64_t explain_pixels = 0;
};

// "scene, lights, method, label".
std::string describe(const PlannedRun& run);

// Of its pictures, below OUT: "colonnade_spot_direct_to_indirect_paper".
std::string folder_name(const PlannedRun& run);

struct RunList {
  std::vector<PlannedRun> runs;  // those on one scene and lighting follow each other, and of them those with
                                 // the same precompute knobs
  std::vector<std::string> left_out;  // one sentence each
};

// Expands the product and checks every name, that of lighting presets too (scenes are loaded for that), so
// that nothing starts before everything is known to exist. `base`: machine settings (threads, cache, gpu).
// Throws UsageError or Error.
RunList make_runs(const Experiment& experiment, const SessionOptions& base, const MethodList& methods,
                  const std::filesystem::path& out);

}  // namespace relight
