#include "experiments/run/explain_runs.h"

#include <cstdio>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run/error.h"
#include "experiments/explain/explain.h"
#include "experiments/session/output_folder.h"

namespace relight {
namespace {

ExplainPlan plan_of(const PlannedRun& run, const std::filesystem::path& out) {
  ExplainPlan plan = plan_explanation(run.plan.session, run.plan.methods.front(), out / folder_name(run));
  plan.pixels = run.explain_pixels;
  return plan;
}

// What decides the numbers, but for the program itself: as in is_record_of().
bool explains(const nlohmann::json& json, const PlannedRun& run) {
  const nlohmann::json& made = json.at("run");
  return json.at("pixels_asked") == run.explain_pixels && made.at("scene_hash") == run.scene_hash &&
         made.value("view_hash", "") == run.view_hash &&
         made.value("lighting_hash", "") == run.lighting_hash && made.at("seed") == run.plan.session.seed &&
         made.at("knobs") == nlohmann::json(run.plan.methods.front().knobs.all());
}

bool has_explanation(const std::filesystem::path& file, const PlannedRun& run) {
  std::ifstream in(file);
  if (!in) return false;
  try {
    return explains(nlohmann::json::parse(in), run);
  } catch (const nlohmann::json::exception&) {
    return false;  // not ours, or of an earlier version: it is made anew
  }
}

}  // namespace

std::vector<size_t> runs_to_explain(const RunList& list, const std::filesystem::path& out, bool again) {
  std::vector<size_t> places;
  for (size_t i = 0; i < list.runs.size(); ++i) {
    const PlannedRun& run = list.runs[i];
    if (run.explain_pixels > 0 && (again || !has_explanation(out / folder_name(run) / "waterfall.json", run)))
      places.push_back(i);
  }
  return places;
}

std::vector<std::string> explain_runs(const RunList& list, const std::vector<size_t>& places,
                                      const std::filesystem::path& out) {
  std::vector<std::string> failures;
  for (size_t n = 0; n < places.size(); ++n) {
    const PlannedRun& run = list.runs[places[n]];
    const std::string name = folder_name(run);
    fmt::print(stderr, "[{}/{}] what the error consists of: {}\n", n + 1, places.size(), name);
    std::optional<Explanation> explanation;
    try {
      explanation = explain(plan_of(run, out));
    } catch (const std::exception& error) {
      failures.push_back(fmt::format("{}, explain-error: {}", name, error.what()));
      fmt::print(stderr, "FAILED {}\n", failures.back());
      continue;
    }
    try {
      write_explanation(*explanation, out / name);
    } catch (const Error& error) {
      throw OutputError(error.what());
    }
  }
  return failures;
}

}  // namespace relight
