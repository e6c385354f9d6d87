#include "experiments/tune/tune_bounds.h"

#include <cmath>

#include <fmt/format.h>

namespace relight {

namespace {

struct Bounded {
  const char* name;
  double value;
  std::optional<double> bound;
  double scale;  // from the value to what people read
  const char* unit;
};

std::vector<Bounded> bounded(const Outcome& o, const TuneBounds& b) {
  return {{"error", o.surely_below(), b.error, 100.0, "%"},
          {"relight", o.relight_ms, b.relight_ms, 1.0, "ms"},
          {"memory", o.memory_mb, b.memory_mb, 1.0, "MB"},
          {"precompute", o.precompute_s, b.precompute_s, 1.0, "s"}};
}

}  // namespace

double violation(const Outcome& outcome, const TuneBounds& bounds) {
  if (!outcome.failure.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Bounded& b : bounded(outcome, bounds)) {
    if (!b.bound || b.value <= *b.bound) continue;
    const double by = std::log(b.value / *b.bound);
    if (!std::isfinite(by)) return std::numeric_limits<double>::infinity();
    sum += by;
  }
  return sum;
}

std::vector<std::string> broken_bounds(const Outcome& outcome, const TuneBounds& bounds) {
  if (!outcome.failure.empty()) return {"failed: " + outcome.failure};
  std::vector<std::string> texts;
  for (const Bounded& b : bounded(outcome, bounds))
    if (b.bound && !(b.value <= *b.bound))
      texts.push_back(fmt::format("{} {:.3g} {} > {:.3g} {}", b.name, b.scale * b.value, b.unit,
                                  b.scale * *b.bound, b.unit));
  return texts;
}

bool better(const Outcome& a, const Outcome& b, const TuneBounds& bounds, double margin) {
  const double va = violation(a, bounds), vb = violation(b, bounds);
  if (va > 0.0 || vb > 0.0) return va == 0.0 || va < vb - std::log1p(margin);
  return a.cost(bounds.minimise) * (1.0 + margin) < b.cost(bounds.minimise);
}

std::string to_string(Cost cost) {
  return cost == Cost::relight ? "relight" : cost == Cost::memory ? "memory" : "precompute";
}

std::string cost_text(const Outcome& outcome, Cost cost) {
  const char* unit = cost == Cost::relight ? "ms" : cost == Cost::memory ? "MB" : "s";
  return fmt::format("{:.3g} {}", outcome.cost(cost), unit);
}

}  // namespace relight
