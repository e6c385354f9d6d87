#include "experiments/regress/error_changes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "common/image/metric_fields.h"

namespace relight {
namespace {

// Published values have seven digits, and sums over pixels may be rounded otherwise.
constexpr double rounding = 2e-6;

// relative errors and the bias are shares; shown in per cent.
bool is_share(const std::string& metric) { return metric.rfind("relative", 0) == 0 || metric == "bias"; }

std::string value_text(const std::string& metric, double value) {
  if (!std::isfinite(value)) return "not finite";
  return is_share(metric) ? fmt::format("{:.3f} %", 100.0 * value) : fmt::format("{:.4g}", value);
}

bool worse(const std::string& metric, double was, double now) {
  if (metric == "ssim") return now < was;
  return std::abs(now) > std::abs(was);
}

double width(double half_width) { return std::isfinite(half_width) ? half_width : 0.0; }

void compare_metric(const std::string& prefix, const std::string& metric, double MetricSet::*field,
                    const ErrorReport& was, const ErrorReport& now, std::vector<Change>& out) {
  const double a = was.value.*field, b = now.value.*field;
  if (std::isfinite(a) != std::isfinite(b)) {
    out.push_back(
        {prefix + metric, Weight::change,
         fmt::format("{}{}: {} -> {}", prefix, metric, value_text(metric, a), value_text(metric, b))});
    return;
  }
  if (!std::isfinite(a) || std::abs(b - a) <= rounding * std::max(std::abs(a), std::abs(b)) + 1e-12) return;
  const double interval = width(was.half_width.*field) + width(now.half_width.*field);
  const bool beyond = std::abs(b - a) > interval;
  out.push_back(
      {prefix + metric, beyond ? Weight::change : Weight::note,
       fmt::format("{}{}: {} -> {}, {}, {} the intervals of both together, {}", prefix, metric,
                   value_text(metric, a), value_text(metric, b), worse(metric, a, b) ? "worse" : "better",
                   beyond ? "beyond" : "within", value_text(metric, interval))});
}

void compare_reports(const std::string& prefix, const std::optional<ErrorReport>& was,
                     const std::optional<ErrorReport>& now, std::vector<Change>& out) {
  if (was.has_value() != now.has_value()) {
    out.push_back({prefix + "errors", Weight::change,
                   fmt::format("{}errors: {}", prefix, now ? "published without any" : "none now")});
    return;
  }
  if (!was) return;
  for (const auto& [metric, field] : metric_fields) compare_metric(prefix, metric, field, *was, *now, out);
}

}  // namespace

void compare_errors(const RunRecord& was, const RunRecord& now, double factor, std::vector<Change>& out) {
  if (factor <= 0.0) {
    compare_reports("", was.errors, now.errors, out);
    compare_reports("indirect ", was.errors_indirect, now.errors_indirect, out);
    return;
  }
  if (!was.errors || !now.errors) return;
  const double a = was.errors->value.relative, b = now.errors->value.relative;
  if (!(b <= factor * a))
    out.push_back({"relative", Weight::change,
                   fmt::format("relative: {} -> {} in the same time, worse by more than {:.2f}",
                               value_text("relative", a), value_text("relative", b), factor)});
}

}  // namespace relight
