#include <cmath>

#include <fmt/format.h>

#include "experiments/compare/compare.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/options/text_table.h"

namespace relight {

namespace {

std::string percent(const std::optional<ErrorReport>& errors, double MetricSet::*metric) {
  if (!errors) return "-";
  const double value = errors->value.*metric;
  return std::isfinite(value) ? fmt::format("{:.2f}", 100.0 * value) : fmt::format("{}", value);
}

std::string floor_percent(const std::optional<ErrorReport>& errors) {
  return errors ? fmt::format("{:.2f}", 100.0 * errors->noise_floor.relative) : "-";
}

std::string notes(const RunRecord& record) {
  std::string text = fmt::format("{}: compared on {}\n", record.method, record.reference_paths);
  if (record.light_paths != record.reference_paths) {
    text += fmt::format("  the method itself carries {}\n", record.light_paths);
  }
  text += fmt::format("  not simulated: {}\n", fmt::join(record.not_simulated, "; "));
  if (record.effect_plan) text += "  effects:\n" + effect_plan_text(*record.effect_plan);
  if (const auto& cost = record.reference) {
    text +=
        fmt::format("  reference: {} paths a pixel, {}, {}\n", cost->samples, cost->estimator,
                    cost->from_cache ? "from the cache" : fmt::format("traced in {:.1f} s", cost->seconds));
  }
  for (const std::string& warning : record.warnings) text += fmt::format("  warning: {}\n", warning);
  for (const std::string& failure : record.failed_stages) text += fmt::format("  FAILED: {}\n", failure);
  return text;
}

}  // namespace

std::string summary_text(const std::vector<RunRecord>& records) {
  TextTable table({"method", "relative %", "edges out %", "indirect %", "noise floor %", "bias %",
                   "precompute s", "relight ms", "MB"});
  for (const RunRecord& r : records) {
    const bool ran = r.relight_ms.repeats > 0;
    table.add_row({r.method + (r.failed_stages.empty() ? "" : " (FAILED)"),
                   percent(r.errors, &MetricSet::relative), percent(r.errors, &MetricSet::relative_edges_out),
                   percent(r.errors_indirect, &MetricSet::relative), floor_percent(r.errors),
                   percent(r.errors, &MetricSet::bias), ran ? fmt::format("{:.2f}", r.precompute_s) : "-",
                   ran ? fmt::format("{:.1f}", r.relight_ms.median) : "-",
                   fmt::format("{:.1f}", 1e-6 * static_cast<double>(prepared_bytes(r)))});
  }
  std::string text = table.to_string(1) + "\n";
  for (const RunRecord& record : records) text += notes(record);
  return text;
}

}  // namespace relight
