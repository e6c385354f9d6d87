// What `relight run --dry-run` prints.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "common/run/progress.h"
#include "experiments/options/parse.h"
#include "experiments/options/text_table.h"
#include "experiments/run/forecast.h"

namespace relight {
namespace {

constexpr int64_t images_a_run = 9;  // write_run_images

std::string megabytes(int64_t bytes) { return fmt::format("{:.0f} MB", 1e-6 * static_cast<double>(bytes)); }

std::vector<std::string> cells(const PlannedRun& run, bool done, const std::optional<RunForecast>& forecast) {
  if (done) return {describe(run), "done", "", "", "", ""};
  if (!forecast) return {describe(run), "unknown", "unknown", "", "unknown", "no record of this method"};
  return {describe(run),
          forecast->precompute_s > 0.0 ? format_duration(forecast->precompute_s) : "shared or none",
          format_duration(forecast->relights_s),
          forecast->reference_s > 0.0 ? format_duration(forecast->reference_s) : "",
          megabytes(forecast->bytes),
          forecast->basis};
}

// Runs with equal precompute knobs on one view share their data.
size_t number_of_precomputes(const std::vector<PlannedRun>& runs) {
  std::set<std::string> keys;
  for (const PlannedRun& run : runs) {
    const SessionOptions& s = run.plan.session;
    const MethodPlan& method = run.plan.methods.front();
    keys.insert(fmt::format("{}\n{}\n{}\n{}\n{}", s.scene, s.view, s.seed, method.method->name(),
                            method.knobs.precompute_key()));
  }
  return keys.size();
}

// Uncompressed, which EXR files stay below.
int64_t image_bytes(const std::vector<PlannedRun>& runs, const std::vector<bool>& done) {
  int64_t bytes = 0;
  for (size_t i = 0; i < runs.size(); ++i) {
    if (done[i]) continue;
    const ViewChoice size = parse_view(runs[i].plan.session.view);
    bytes += images_a_run * 12 * static_cast<int64_t>(size.width) * size.height;
  }
  return bytes;
}

}  // namespace

std::string plan_text(const std::vector<PlannedRun>& runs, const std::vector<bool>& done,
                      const Forecasts& forecasts) {
  const auto each = forecasts.of(runs, done);
  TextTable table({"run", "precompute", "relights", "scene and reference", "memory", "estimate from"});
  int64_t most = 0;
  size_t unknown = 0;
  for (size_t i = 0; i < runs.size(); ++i) {
    table.add_row(cells(runs[i], done[i], each[i]));
    if (each[i]) most = std::max(most, each[i]->bytes);
    unknown += each[i] ? 0 : 1;
  }
  const auto finished = static_cast<size_t>(std::count(done.begin(), done.end(), true));
  const std::optional<double> seconds = seconds_in_all(each, done);
  std::string text = table.to_string();
  text += fmt::format("\n{} to do, {} done before; {} sets of prepared data\n", runs.size() - finished,
                      finished, number_of_precomputes(runs));
  text += fmt::format("time in all: {}", seconds ? "about " + format_duration(*seconds) : "unknown");
  if (unknown > 0 && seconds) text += fmt::format(" ({} runs unknown, taken for average ones)", unknown);
  text += fmt::format("\nbytes: prepared data {} a run at most, images {} on disk at most\n",
                      seconds && most > 0 ? megabytes(most) : "unknown", megabytes(image_bytes(runs, done)));
  text += fmt::format(
      "estimates rest on {} records of this machine (processor, threads, build) in the output folder and in "
      "results/, scaled by pixels; what is in the cache already costs less\n",
      forecasts.records());
  return text;
}

}  // namespace relight
