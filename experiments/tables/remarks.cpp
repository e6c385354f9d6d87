#include "experiments/tables/remarks.h"

#include <cmath>

#include <fmt/format.h>

namespace relight::tables {
namespace {

constexpr double notable_bias = 0.01;     // of the picture's mean
constexpr double notable_slowness = 2.0;  // times

std::string bias_remark(const RunRecord& record) {
  const double bias = record.errors->value.bias, half = record.errors->half_width.bias;
  if (!(std::abs(bias) - half >= notable_bias)) return "";
  return fmt::format("{:.1f} % too {}", 100 * std::abs(bias), bias < 0 ? "dark" : "bright");
}

// Who is not worse in error and needs the smallest part of the time.
std::string slowness_remark(const Point& point, const Group& group) {
  const Measured& time = point[CostKind::relight];
  const Point* fastest = nullptr;
  for (const Point& other : group.points) {
    if (!other.comparable(ErrorKind::relative, CostKind::relight)) continue;
    const bool not_worse = other[ErrorKind::relative].value <= point[ErrorKind::relative].high;
    const bool faster = other[CostKind::relight].high < time.low;
    if (not_worse && faster &&
        (!fastest || other[CostKind::relight].value < (*fastest)[CostKind::relight].value))
      fastest = &other;
  }
  if (!fastest) return "";
  const double times = time.value / (*fastest)[CostKind::relight].value;
  if (!(times >= notable_slowness)) return "";
  return fmt::format("{:.1f} times slower than {}, which is no less exact", times, fastest->name());
}

}  // namespace

std::vector<std::string> remarks(const Point& point, const RunRecord& record, const Group& group) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& text) {
    if (!text.empty()) all.push_back(text);
  };
  if (!point.failure.empty()) return {"FAILED: " + point.failure};
  add(bias_remark(record));
  if (point[ErrorKind::relative].low <= floor_of(record, ErrorKind::relative))
    add("its error may be the reference's noise alone");
  if (point[CostKind::relight].known()) add(slowness_remark(point, group));
  return all;
}

}  // namespace relight::tables
