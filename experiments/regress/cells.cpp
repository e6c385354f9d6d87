#include "experiments/regress/cells.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace relight {
namespace {

using Cell = std::function<std::string(const RunRecord&)>;

std::string pair_text(const RunComparison& run, const Cell& cell) {
  const std::string was = run.published ? cell(*run.published) : "", now = run.fresh ? cell(*run.fresh) : "";
  if (!run.published) return now;
  if (!run.fresh || was == now) return was;
  return fmt::format("{} -> {}", was, now);
}

std::string percent(const RunRecord& r, double MetricSet::*metric) {
  if (!r.errors) return "-";
  const double value = r.errors->value.*metric;
  return std::isfinite(value) ? fmt::format("{:.2f}", 100.0 * value) : "not finite";
}

// A whole experiment may have changed in the same twenty counters.
constexpr size_t most_names = 4;

std::string changed_names(const RunComparison& run) {
  std::string names;
  size_t count = 0;
  for (const Change& change : run.changes) {
    if (change.weight == Weight::note) continue;
    if (++count > most_names) continue;
    if (!names.empty()) names += ", ";
    names += change.what == "failed" ? "FAILED" : change.what;
  }
  return count > most_names ? fmt::format("{} and {} more", names, count - most_names) : names;
}

}  // namespace

RegressionCells cells_of(const RunComparison& run) {
  return {pair_text(run, [](const RunRecord& r) { return percent(r, &MetricSet::relative); }),
          pair_text(run, [](const RunRecord& r) { return percent(r, &MetricSet::bias); }),
          pair_text(run,
                    [](const RunRecord& r) {
                      return r.relight_ms.repeats > 0 ? fmt::format("{:.1f}", r.relight_ms.median) : "-";
                    }),
          pair_text(run,
                    [](const RunRecord& r) {
                      return r.relight_ms.repeats > 0 ? fmt::format("{:.2f}", r.precompute_s) : "-";
                    }),
          changed_names(run)};
}

}  // namespace relight
