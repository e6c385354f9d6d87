// `relight explain-error`: how much of a method's error comes from which of its approximations, and what each
// saves. Works on any method by the stages that it declares (Method::error_stages).
#pragma once

#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/explain/explain_plan.h"
#include "experiments/explain/setting_runner.h"
#include "experiments/explain/waterfall.h"

namespace relight {

struct Explanation {
  RunRecord run;  // what was run, where; errors are those of the method as asked, on the pixels chosen
  int64_t pixels = 0, blocks = 0;
  double pixel_share = 0.0, edge_share = 0.0;  // of the view; of the pixels chosen
  double shared_s = 0.0;                       // what all settings share, and one relight
  double load_average = 0.0;                   // of the machine before the first setting, one minute
  std::vector<SettingRecord> settings;
  Waterfall waterfall;
};

// Runs every setting and the reference. Throws Error if one of them fails.
Explanation explain(const ExplainPlan& plan);

// The table for a terminal.
std::string waterfall_text(const Explanation& explanation);

// One line a bar: the method as asked, its stages, the remainder, closer settings. Errors in per cent.
std::string waterfall_csv(const Explanation& explanation);
// Everything, with the settings, times and provenance.
std::string waterfall_json(const Explanation& explanation);

}  // namespace relight
