// `relight explain-error`: how much of a method's error comes from which of its approximations, and what each
// saves. Works on any method by the stages that it declares (Method::error_stages).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/explain/explain_plan.h"
#include "experiments/explain/setting_runner.h"
#include "experiments/explain/waterfall.h"

namespace relight {

// What the method leaves out on purpose, apart from what it approximates: the reference restricted to the
// method's light paths beside one that carries every path. No part of the method's error.
struct ModelError {
  Measures share{}, half_width{};  // |restricted - every| / |every|; 95 %, over the choice of pixels
  LightPaths paths;                // of the reference that carries every path
  double seconds = 0.0;            // that it took
};

struct Explanation {
  RunRecord run;  // what was run, where; errors are those of the method as asked, on the pixels chosen
  int64_t pixels_asked = 0, pixels = 0, blocks = 0;  // whole blocks: at least as many as asked
  double pixel_share = 0.0, edge_share = 0.0;        // of the view; of the pixels chosen
  double shared_s = 0.0;                             // what all settings share, and one relight
  double load_average = 0.0;                         // of the machine before the first setting, one minute
  std::vector<SettingRecord> settings;
  Waterfall waterfall;
  ModelError model;
};

// Runs every setting and the reference. Throws Error if one of them fails.
Explanation explain(const ExplainPlan& plan);

// What the share of e.model is a share of, and which light it is: a sentence.
std::string model_sentence(const Explanation& explanation);

// The table for a terminal.
std::string waterfall_text(const Explanation& explanation);

// One line a bar: the method as asked, its stages, the remainder, closer settings. Errors in per cent.
std::string waterfall_csv(const Explanation& explanation);
// Everything, with the settings, times and provenance.
std::string waterfall_json(const Explanation& explanation);
// Both as waterfall.csv and waterfall.json, each replaced as a whole, the second last. Throws Error if one
// cannot be written.
void write_explanation(const Explanation& explanation, const std::filesystem::path& folder);

}  // namespace relight
