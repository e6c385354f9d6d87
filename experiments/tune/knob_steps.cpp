#include "experiments/tune/knob_steps.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace relight {

namespace {

using Steps = KnobTuning::Steps;

double number(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::optional<std::string> next_choice(const KnobTuning& tuning, const std::string& value,
                                       Direction direction) {
  const auto at = std::find(tuning.choices.begin(), tuning.choices.end(), value);
  if (at == tuning.choices.end()) return std::nullopt;
  if (direction == Direction::dearer)
    return at + 1 == tuning.choices.end() ? std::nullopt : std::optional(at[1]);
  return at == tuning.choices.begin() ? std::nullopt : std::optional(at[-1]);
}

// "0.07" rather than 0.07000000000000001: four digits are more than a step needs.
std::string written(const Knob& knob, double value) {
  return knob.type == KnobType::integer ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

}  // namespace

std::optional<std::string> next_value(const Knob& knob, const std::string& value, Direction direction) {
  const KnobTuning& t = knob.tuning;
  if (t.steps == Steps::none) return std::nullopt;
  if (t.steps == Steps::choices) return next_choice(t, value, direction);
  const bool whole_range = t.low == 0.0 && t.high == 0.0;
  const double low = whole_range ? knob.min : std::max(t.low, knob.min);
  const double high = whole_range ? knob.max : std::min(t.high, knob.max);
  const double now = number(value);
  const bool up = (direction == Direction::dearer) == t.larger_costs_more;
  if (now == 0.0 && low > 0.0) {
    if (direction == Direction::dearer) return std::nullopt;
    return written(knob, t.larger_costs_more ? high : low);
  }
  double next =
      t.steps == Steps::factor ? (up ? now * t.step : now / t.step) : (up ? now + t.step : now - t.step);
  if (knob.type == KnobType::integer) {
    next = std::round(next);
    if (next == now) next += up ? 1.0 : -1.0;
  }
  next = std::clamp(next, low, high);
  if (up ? !(next > now) : !(next < now)) return std::nullopt;
  std::string text = written(knob, next);
  return text == value ? std::nullopt : std::optional(std::move(text));
}

bool idle(const Knob& knob, const KnobValues& values) {
  const auto other = values.all().find(knob.tuning.idle_knob);
  if (other == values.all().end()) return false;
  const auto& idle_values = knob.tuning.idle_values;
  return std::find(idle_values.begin(), idle_values.end(), other->second) != idle_values.end();
}

std::vector<const Knob*> tunable_knobs(const KnobTable& table) {
  std::vector<const Knob*> knobs;
  for (const KnobPhase phase : {KnobPhase::relight, KnobPhase::precompute})
    for (const Knob& knob : table)
      if (knob.phase == phase && knob.tuning.steps != Steps::none) knobs.push_back(&knob);
  return knobs;
}

}  // namespace relight
