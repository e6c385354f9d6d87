// What `relight explain-error` was asked to do: options as typed, and the checked plan made of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiments/compare/plan.h"

namespace relight {

struct ExplainOptions {
  SessionOptions session;
  std::string method;
  std::string preset = "paper";
  std::vector<std::string> settings;  // "method.knob=value"
  int64_t pixels = 1024;
  std::string block = "4x4";  // pixels that are chosen together
  int reference_samples = 4096;
  int repeats = 0;      // timed relights of each setting; 0: as in compare
  bool closer = false;  // also run the settings that should shrink the remainder
  std::string out;
};

struct ExplainPlan {
  SessionOptions session;
  MethodPlan method;
  ErrorStages stages;
  int64_t pixels = 1024;
  glm::ivec2 block{4};
  int reference_samples = 4096;
  int repeats = 0;
  bool closer = false;
  std::filesystem::path out;
};

// A plan with the default block for a method whose knobs are checked. Throws std::logic_error if the method's
// stages name knobs that it doesn't have, or change its light paths.
ExplainPlan plan_explanation(const SessionOptions& session, MethodPlan method,
                             const std::filesystem::path& out);

constexpr int64_t most_explained_pixels = 1 << 20;

// Checks all that can be checked without loading the scene. `methods` must outlive the plan. Throws
// UsageError, and what plan_explanation() throws.
ExplainPlan make_explain_plan(const ExplainOptions& options, const MethodList& methods);

// The knobs with the overrides of a stage, which must be valid.
KnobValues with_overrides(KnobValues knobs, const ErrorStage& stage);

// The command line that repeats the run, with every knob written out.
std::string command_line(const ExplainPlan& plan, const std::string& lights);

}  // namespace relight
