// What `relight tune` was asked to do: options as typed, and the checked plan made of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"
#include "experiments/tune/tune_bounds.h"

namespace relight {

enum class ErrorMetric { relative, relative_edges_out, indirect };
std::string to_string(ErrorMetric metric);

struct TuneOptions {
  SessionOptions session;
  std::string error;                                       // share: "0.05" or "5%"
  double relight_ms = 0, memory_mb = 0, precompute_s = 0;  // bounds; 0: none
  std::string minimise = "relight";
  std::string metric = "relative";
  std::vector<std::string> methods;   // names; none: all
  std::vector<std::string> settings;  // "method.knob=value": knobs that the search leaves alone
  std::string verify_lights;          // comma-separated presets or files; empty: chosen
  double budget_s = 600;              // of the search
  int runs = 60;                      // settings measured, all methods together
  int reference_samples = 256;
  int repeats = 3;
  std::string out = "out/tune";
};

struct TunePlan {
  SessionOptions session;
  TuneBounds bounds;
  ErrorMetric metric = ErrorMetric::relative;
  std::vector<std::vector<MethodPlan>> starts;  // of each method: paper and its presets
  std::vector<std::string> verify_lights;
  double budget_s = 600;
  int runs = 60;
  int reference_samples = 256, repeats = 3;
  std::filesystem::path out;
  std::string command;  // that repeats the search
};

// Checks all that can be checked without loading the scene. `methods` must outlive the plan. Throws
// UsageError naming option, value and the valid ones.
TunePlan make_tune_plan(const TuneOptions& options, const MethodList& methods);

// The comparison that measures settings under the session's lighting; its records' commands write to
// OUT/chosen.
ComparePlan compare_plan(const TunePlan& plan);

// The outcome that a record holds.
Outcome outcome_of(const RunRecord& record, ErrorMetric metric);

}  // namespace relight
