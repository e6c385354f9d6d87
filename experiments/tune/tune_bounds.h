// What a setting must keep, what it should cost as little of as possible, and which of two settings is
// better.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace relight {

enum class Cost { relight, memory, precompute };

// Of one setting. Costs are NaN where they are not known.
struct Outcome {
  double error = std::numeric_limits<double>::quiet_NaN();  // share, in the metric that was asked for
  double half_width = 0.0;                                  // of its 95 % interval
  double relight_ms = std::numeric_limits<double>::quiet_NaN();
  double memory_mb = std::numeric_limits<double>::quiet_NaN();
  double precompute_s = std::numeric_limits<double>::quiet_NaN();
  std::string failure;  // empty if it ran through

  // The upper end of the interval is what must keep the bound.
  double surely_below() const { return error + half_width; }
  double cost(Cost of) const {
    return of == Cost::relight ? relight_ms : of == Cost::memory ? memory_mb : precompute_s;
  }
};

struct TuneBounds {
  double error = 0.05;
  std::optional<double> relight_ms, memory_mb, precompute_s;
  Cost minimise = Cost::relight;
};

// 0 if every bound is kept, else the sum over the broken ones of log(value / bound); infinity for a failed
// setting and for values that are not numbers. So "closest" does not depend on units.
double violation(const Outcome& outcome, const TuneBounds& bounds);

// One text a broken bound: "error 6.10 % > 5.00 %"; of a failed setting why it failed.
std::vector<std::string> broken_bounds(const Outcome& outcome, const TuneBounds& bounds);

// Is `a` better by more than timing noise? A setting that keeps all bounds is better than one that doesn't;
// of two that do, the cheaper by `margin`, of two that don't, the one closer to the bounds by log(1 +
// margin).
bool better(const Outcome& a, const Outcome& b, const TuneBounds& bounds, double margin = 0.02);

std::string to_string(Cost cost);                          // "relight", "memory", "precompute"
std::string cost_text(const Outcome& outcome, Cost cost);  // with its unit: "12.3 ms"

}  // namespace relight
