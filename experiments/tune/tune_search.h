// The search of `relight tune`: coordinate steps over a knob table, then exchanges of two steps. It knows no
// method: how knobs may be turned is data in their table, and what a setting gives is told by a function.
//
// From each start (presets, the best first): every knob is stepped, relight knobs first, while that makes the
// setting better; until a whole round over the knobs changes nothing. At such a point a single step cannot
// trade accuracy where it is dear for accuracy where it is cheap. So then pairs of steps are tried, chosen by
// what their single steps did to error and costs (the logarithms added): the most promising first, a few a
// round. If one is better, rounds begin again. What was measured once is not measured again.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/run/knobs.h"
#include "experiments/tune/knob_steps.h"
#include "experiments/tune/tune_bounds.h"

namespace relight {

struct Tried {
  KnobValues knobs;
  std::string why;  // "preset best", "coefficients 100 -> 160"
  Outcome outcome;
};

class TuneSearch {
 public:
  using Measure = std::function<Outcome(const KnobValues& knobs, const std::string& why)>;
  // Asked before each setting that is not known yet; false ends the search.
  using MayGoOn = std::function<bool()>;
  // Whether a setting computes the same as another start asks for; a step that leaves this is not taken.
  using Allowed = std::function<bool(const KnobValues& from, const KnobValues& to)>;

  // fixed: knobs that are left alone.
  TuneSearch(TuneBounds bounds, std::set<std::string> fixed, Measure measure, MayGoOn may_go_on,
             Allowed allowed = {});

  // From these starts, (knobs, why) each. Returns true if it ended by itself, false if may_go_on ended it.
  bool run(const std::vector<std::pair<KnobValues, std::string>>& starts);

  // In the order in which they were measured.
  const std::vector<Tried>& tried() const { return tried_; }
  // The best of all that was tried; null if nothing was.
  const Tried* best() const;

 private:
  struct OutOfBudget {};
  struct Step {
    const Knob* knob;
    Direction direction;
    std::string value;
  };
  size_t measure(const KnobValues& knobs, const std::string& why);
  bool is_better(size_t a, size_t b) const;
  bool promising(size_t a, size_t b) const;
  std::vector<Step> steps_from(const KnobValues& knobs) const;
  size_t descend(size_t at);
  bool sweep(size_t& at);
  bool turn(size_t& at, const Knob& knob);
  bool exchange(size_t& at);

  TuneBounds bounds_;
  std::set<std::string> fixed_;
  Measure measure_;
  MayGoOn may_go_on_;
  Allowed allowed_;
  std::vector<Tried> tried_;
  std::map<std::map<std::string, std::string>, size_t> known_;  // knobs -> index into tried_
  std::set<size_t> ends_;                                       // where descents ended
};

}  // namespace relight
