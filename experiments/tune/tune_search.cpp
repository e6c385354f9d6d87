#include "experiments/tune/tune_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace relight {

namespace {

constexpr size_t exchanges_a_round = 6;
constexpr int most_repairs = 3;

KnobValues with(KnobValues knobs, const std::string& name, const std::string& value) {
  knobs.set(name, value);
  return knobs;
}

std::string change_text(const KnobValues& from, const std::string& knob, const std::string& value) {
  return fmt::format("{} {} -> {}", knob, from.all().at(knob), value);
}

// What two steps together would give, if each multiplied error and costs as it did alone.
Outcome predicted(const Outcome& at, const Outcome& a, const Outcome& b) {
  const auto together = [](double from, double one, double other) {
    return from > 0.0 ? one * other / from : std::max(one, other);
  };
  Outcome both;
  both.error = together(at.surely_below(), a.surely_below(), b.surely_below());
  both.relight_ms = together(at.relight_ms, a.relight_ms, b.relight_ms);
  both.memory_mb = together(at.memory_mb, a.memory_mb, b.memory_mb);
  both.precompute_s = together(at.precompute_s, a.precompute_s, b.precompute_s);
  return both;
}

// Did a step change nothing that a search goes by?
bool nothing_changed(const Outcome& a, const Outcome& b) {
  const auto same = [](double x, double y) {
    return (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= 0.02 * std::max(x, y);
  };
  return a.failure == b.failure && a.error == b.error && same(a.relight_ms, b.relight_ms) &&
         same(a.memory_mb, b.memory_mb) && same(a.precompute_s, b.precompute_s);
}

}  // namespace

TuneSearch::TuneSearch(TuneBounds bounds, std::set<std::string> fixed, Measure measure, MayGoOn may_go_on,
                       Allowed allowed)
    : bounds_(bounds),
      fixed_(std::move(fixed)),
      measure_(std::move(measure)),
      may_go_on_(std::move(may_go_on)),
      allowed_(std::move(allowed)) {}

bool TuneSearch::run(const std::vector<std::pair<KnobValues, std::string>>& starts) {
  try {
    std::vector<size_t> order;
    for (const auto& [knobs, why] : starts) {
      const size_t index = measure(knobs, why);
      if (std::find(order.begin(), order.end(), index) == order.end()) order.push_back(index);
    }
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return is_better(a, b); });
    for (const size_t start : order) ends_.insert(descend(start));
  } catch (const OutOfBudget&) {
    return false;
  }
  return true;
}

const Tried* TuneSearch::best() const {
  const Tried* best = nullptr;
  for (const Tried& t : tried_)
    if (!best || better(t.outcome, best->outcome, bounds_, 0.0)) best = &t;
  return best;
}

size_t TuneSearch::measure(const KnobValues& knobs, const std::string& why) {
  const auto found = known_.find(knobs.all());
  if (found != known_.end()) return found->second;
  if (!may_go_on_()) throw OutOfBudget{};
  tried_.push_back({knobs, why, measure_(knobs, why)});
  known_.emplace(knobs.all(), tried_.size() - 1);
  return tried_.size() - 1;
}

bool TuneSearch::is_better(size_t a, size_t b) const {
  return better(tried_[a].outcome, tried_[b].outcome, bounds_);
}

size_t TuneSearch::descend(size_t at) {
  while (!ends_.contains(at) && (sweep(at) || exchange(at))) {
  }
  return at;
}

bool TuneSearch::sweep(size_t& at) {
  bool moved = false;
  // A copy: measuring moves what it points into.
  const KnobTable table = tried_[at].knobs.table();
  for (const Knob* knob : tunable_knobs(table))
    if (!fixed_.contains(knob->name)) moved = turn(at, *knob) || moved;
  return moved;
}

// Steps in one direction while it gets better, else in the other: first the one that the setting needs,
// cheaper if it keeps the bounds, dearer if not.
bool TuneSearch::turn(size_t& at, const Knob& knob) {
  const bool keeps = violation(tried_[at].outcome, bounds_) == 0.0;
  const Direction first = keeps ? Direction::cheaper : Direction::dearer;
  const Direction second = keeps ? Direction::dearer : Direction::cheaper;
  for (const Direction direction : {first, second}) {
    bool moved = false;
    while (!idle(knob, tried_[at].knobs)) {
      const KnobValues from = tried_[at].knobs;
      const auto value = next_value(knob, from.all().at(knob.name), direction);
      if (!value) break;
      const KnobValues to = with(from, knob.name, *value);
      if (allowed_ && !allowed_(from, to)) break;
      const size_t next = measure(to, change_text(from, knob.name, *value));
      if (!is_better(next, at)) {
        if (!moved && nothing_changed(tried_[next].outcome, tried_[at].outcome)) return false;
        break;
      }
      at = next, moved = true;
    }
    if (moved) return true;
  }
  return false;
}

std::vector<TuneSearch::Step> TuneSearch::steps_from(const KnobValues& knobs) const {
  std::vector<Step> steps;
  for (const Knob* knob : tunable_knobs(knobs.table())) {
    if (fixed_.contains(knob->name) || idle(*knob, knobs)) continue;
    for (const Direction direction : {Direction::cheaper, Direction::dearer}) {
      const auto value = next_value(*knob, knobs.all().at(knob->name), direction);
      if (value) steps.push_back({knob, direction, *value});
    }
  }
  return steps;
}

// Cheaper than a setting that keeps the bounds, but beyond one.
bool TuneSearch::promising(size_t a, size_t b) const {
  const Outcome &cheap = tried_[a].outcome, &good = tried_[b].outcome;
  return violation(good, bounds_) == 0.0 && violation(cheap, bounds_) > 0.0 && cheap.failure.empty() &&
         cheap.cost(bounds_.minimise) < good.cost(bounds_.minimise);
}

bool TuneSearch::exchange(size_t& at) {
  const KnobValues from = tried_[at].knobs;
  const Outcome here = tried_[at].outcome;
  struct Pair {
    KnobValues knobs;
    std::string why;
    Outcome predicted;
    Step repair;  // of the two steps the one that leaves the smaller error
  };
  std::vector<Pair> pairs;
  const std::vector<Step> steps = steps_from(from);
  const auto outcome_of = [&](const Step& step) -> const Outcome* {
    const auto found = known_.find(with(from, step.knob->name, step.value).all());
    return found == known_.end() || !tried_[found->second].outcome.failure.empty()
               ? nullptr
               : &tried_[found->second].outcome;
  };
  for (size_t i = 0; i < steps.size(); ++i)
    for (size_t j = i + 1; j < steps.size(); ++j) {
      const Outcome *a = outcome_of(steps[i]), *b = outcome_of(steps[j]);
      if (steps[i].knob == steps[j].knob || !a || !b) continue;
      if (nothing_changed(*a, here) || nothing_changed(*b, here)) continue;
      const Outcome both = predicted(here, *a, *b);
      const KnobValues to =
          with(with(from, steps[i].knob->name, steps[i].value), steps[j].knob->name, steps[j].value);
      if (!better(both, here, bounds_) || known_.contains(to.all()) || (allowed_ && !allowed_(from, to)))
        continue;
      pairs.push_back({to,
                       change_text(from, steps[i].knob->name, steps[i].value) + ", " +
                           change_text(from, steps[j].knob->name, steps[j].value),
                       both, a->error <= b->error ? steps[i] : steps[j]});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return better(a.predicted, b.predicted, bounds_, 0.0);
  });
  for (size_t i = 0; i < std::min(pairs.size(), exchanges_a_round); ++i) {
    size_t next = measure(pairs[i].knobs, pairs[i].why);
    for (int more = 0; more < most_repairs && !is_better(next, at) && promising(next, at); ++more) {
      const KnobValues cheap = tried_[next].knobs;
      const Step& repair = pairs[i].repair;
      const auto value = next_value(*repair.knob, cheap.all().at(repair.knob->name), repair.direction);
      if (!value) break;
      const KnobValues to = with(cheap, repair.knob->name, *value);
      if (allowed_ && !allowed_(from, to)) break;
      next = measure(to, change_text(cheap, repair.knob->name, *value));
    }
    if (!is_better(next, at)) continue;
    at = next;
    return true;
  }
  return false;
}

}  // namespace relight
