#include "experiments/tables/measures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace relight::tables {
namespace {

const std::optional<ErrorReport>& report_of(const RunRecord& record, ErrorKind error) {
  return error == ErrorKind::indirect ? record.errors_indirect : record.errors;
}

double MetricSet::*metric_of(ErrorKind error) {
  return error == ErrorKind::edges_out ? &MetricSet::relative_edges_out : &MetricSet::relative;
}

// Three significant digits, without an exponent.
std::string three_digits(double value) {
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.095 ? 2 : 3);
}

}  // namespace

bool Measured::known() const { return std::isfinite(value); }

bool overlap(const Measured& a, const Measured& b) {
  return a.known() && b.known() && a.low <= b.high && b.low <= a.high;
}

const char* key(ErrorKind error) {
  return error == ErrorKind::relative ? "relative" : error == ErrorKind::edges_out ? "edges_out" : "indirect";
}

const char* key(CostKind cost) {
  return cost == CostKind::relight ? "relight" : cost == CostKind::memory ? "memory" : "precompute";
}

const char* title(ErrorKind error) {
  return error == ErrorKind::relative    ? "relative error"
         : error == ErrorKind::edges_out ? "relative error without edges"
                                         : "relative error of indirect light";
}

const char* title(CostKind cost) {
  return cost == CostKind::relight ? "relight time" : cost == CostKind::memory ? "memory" : "precompute time";
}

Measured error_of(const RunRecord& record, ErrorKind error) {
  const auto& report = report_of(record, error);
  if (!report) return {};
  const double value = report->value.*metric_of(error), half = report->half_width.*metric_of(error);
  return {value, std::max(0.0, value - half), value + half};
}

double floor_of(const RunRecord& record, ErrorKind error) {
  const auto& report = report_of(record, error);
  return report ? report->noise_floor.*metric_of(error) : std::numeric_limits<double>::quiet_NaN();
}

Measured relight_ms_of(const RunRecord& record) {
  const RelightTime& t = record.relight_ms;
  return t.repeats > 0 ? Measured{t.median, t.min, t.max} : Measured{};
}

std::string cost_text(CostKind cost, double value) {
  if (!std::isfinite(value)) return "-";
  if (cost == CostKind::memory) return value == 0 ? "0" : three_digits(1e-6 * value) + " MB";
  const double seconds = cost == CostKind::relight ? 1e-3 * value : value;
  return seconds < 1 ? three_digits(1e3 * seconds) + " ms" : three_digits(seconds) + " s";
}

std::string error_text(double share) {
  return std::isfinite(share) ? three_digits(100 * share) + " %" : "not finite";
}

std::string error_text(const Measured& error) {
  const double half = 0.5 * (error.high - error.low);
  if (!error.known() || !(half >= 5e-5)) return error_text(error.value);
  return fmt::format("{} ± {:.2f} %", three_digits(100 * error.value), 100 * half);
}

}  // namespace relight::tables
