// Knobs: the settings of a method. The table is the single source for the command line's help, `--set`,
// experiment files, run records and documentation.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace relight {

enum class KnobType { integer, real, choice, boolean };
// A precompute knob changes the prepared data (and its cache key); a relight knob only the query.
enum class KnobPhase { precompute, relight };

// How a search for a cheap setting may turn a knob: data, so that no search needs to know a knob by name.
struct KnobTuning {
  enum class Steps {
    none,    // no knob to tune: it decides what is computed, not how well
    factor,  // value x step, value / step
    add,     // value + step, value - step
    choices  // the next of `choices`, in either direction
  };
  Steps steps = Steps::none;
  double step = 2.0;
  double low = 0.0, high = 0.0;           // where a search may go; both 0: the valid range
  std::vector<std::string> choices = {};  // those worth trying, usually the cheapest first
  bool larger_costs_more = true;          // and is usually better: which direction is tried first
  // Another knob, and its values with which this one changes nothing; none: it always may.
  std::string idle_knob = {};
  std::vector<std::string> idle_values = {};

  KnobTuning idle_while(std::string knob, std::vector<std::string> values) const {
    KnobTuning tuning = *this;
    tuning.idle_knob = std::move(knob), tuning.idle_values = std::move(values);
    return tuning;
  }
};
inline KnobTuning tuned_by_factor(double step, double low, double high, bool larger_costs_more = true) {
  return {KnobTuning::Steps::factor, step, low, high, {}, larger_costs_more, {}, {}};
}
inline KnobTuning tuned_by_adding(double step, double low, double high, bool larger_costs_more = true) {
  return {KnobTuning::Steps::add, step, low, high, {}, larger_costs_more, {}, {}};
}
inline KnobTuning tuned_by_choice(std::vector<std::string> cheapest_first) {
  return {KnobTuning::Steps::choices, 0.0, 0.0, 0.0, std::move(cheapest_first), true, {}, {}};
}

struct Knob {
  std::string name;
  KnobType type;
  KnobPhase phase;
  std::string default_value;         // equal to the paper's value where the paper gives one
  double min = 0.0, max = 0.0;       // for integer and real
  std::vector<std::string> choices;  // for choice
  std::string stage;                 // the stage whose cost it changes
  std::string help;                  // one sentence
  KnobTuning tuning = {};            // none unless the table says so
};

using KnobTable = std::vector<Knob>;

// A named choice of values for some knobs; the others keep their defaults. "paper" is the name of the
// defaults themselves and never in a list.
struct KnobPreset {
  std::string name;
  std::string help;                                         // one sentence
  std::vector<std::pair<std::string, std::string>> values;  // knob, value
};

// Values for every knob of one table. Getters throw std::logic_error on a name or type the table does not
// have.
class KnobValues {
 public:
  KnobValues() = default;
  explicit KnobValues(KnobTable table);  // all defaults
  // Parses and range-checks; Error names the knob, the value, and the valid names, range or choices.
  void set(const std::string& name, const std::string& value);
  int64_t integer(const std::string& name) const;
  double real(const std::string& name) const;
  bool boolean(const std::string& name) const;
  const std::string& choice(const std::string& name) const;
  const std::map<std::string, std::string>& all() const { return values_; }
  const KnobTable& table() const { return table_; }
  // "name=value;..." of the precompute knobs only, sorted by name: part of the artefact cache key.
  std::string precompute_key() const;

 private:
  const std::string& value(const std::string& name, KnobType type) const;
  KnobTable table_;
  std::map<std::string, std::string> values_;
};

}  // namespace relight
