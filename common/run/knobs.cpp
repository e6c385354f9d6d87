#include "common/run/knobs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/run/error.h"

namespace relight {

namespace {

const Knob* find_knob(const KnobTable& table, const std::string& name) {
  const auto same_name = [&](const Knob& knob) { return knob.name == name; };
  const auto found = std::find_if(table.begin(), table.end(), same_name);
  return found == table.end() ? nullptr : &*found;
}

std::string names_of(const KnobTable& table) {
  std::vector<std::string> names;
  for (const Knob& knob : table) names.push_back(knob.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// The whole text must be one number; the message shows both ends of the range.
template <typename T>
T parse_number(const Knob& knob, const std::string& text, const char* kind) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool is_number = error == std::errc() && stop == end && std::isfinite(static_cast<double>(value));
  if (!is_number)
    fail("knob '{}': '{}' is not {}; valid range: {} to {}", knob.name, text, kind, knob.min, knob.max);
  if (static_cast<double>(value) < knob.min || static_cast<double>(value) > knob.max)
    fail("knob '{}': {} is out of range; valid range: {} to {}", knob.name, text, knob.min, knob.max);
  return value;
}

// One spelling for one value, so that "010" and "10" share a cache entry.
std::string canonical_value(const Knob& knob, const std::string& text) {
  switch (knob.type) {
    case KnobType::integer:
      return fmt::format("{}", parse_number<int64_t>(knob, text, "a whole number"));
    // "+ 0.0" turns -0 into 0.
    case KnobType::real:
      return fmt::format("{}", parse_number<double>(knob, text, "a finite number") + 0.0);
    case KnobType::boolean:
      if (text == "true" || text == "on" || text == "1") return "true";
      if (text == "false" || text == "off" || text == "0") return "false";
      fail("knob '{}': '{}' is not a valid value; valid: true, false", knob.name, text);
    case KnobType::choice:
      if (std::find(knob.choices.begin(), knob.choices.end(), text) != knob.choices.end()) return text;
      fail("knob '{}': '{}' is not a valid choice; valid: {}", knob.name, text,
           fmt::join(knob.choices, ", "));
  }
  throw std::logic_error("knob '" + knob.name + "' has an unknown type");
}

}  // namespace

KnobValues::KnobValues(KnobTable table) : table_(std::move(table)) {
  for (const Knob& knob : table_) {
    if (values_.count(knob.name)) throw std::logic_error("knob '" + knob.name + "' is listed twice");
    try {
      set(knob.name, knob.default_value);
    } catch (const Error& error) {
      // A default that its own table rejects is a programmer's mistake, not a user's.
      throw std::logic_error(std::string("default of ") + error.what());
    }
  }
}

void KnobValues::set(const std::string& name, const std::string& value) {
  const Knob* knob = find_knob(table_, name);
  if (!knob) fail("unknown knob '{}'; valid knobs: {}", name, names_of(table_));
  values_[name] = canonical_value(*knob, value);
}

const std::string& KnobValues::value(const std::string& name, KnobType type) const {
  const Knob* knob = find_knob(table_, name);
  if (!knob) throw std::logic_error("no knob '" + name + "' in this table");
  if (knob->type != type) throw std::logic_error("knob '" + name + "' has another type");
  return values_.at(name);
}

int64_t KnobValues::integer(const std::string& name) const {
  return std::stoll(value(name, KnobType::integer));
}

double KnobValues::real(const std::string& name) const {
  const std::string& text = value(name, KnobType::real);
  double number = 0.0;
  // Not std::stod: that reads with the user's locale.
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

bool KnobValues::boolean(const std::string& name) const { return value(name, KnobType::boolean) == "true"; }

const std::string& KnobValues::choice(const std::string& name) const { return value(name, KnobType::choice); }

std::string KnobValues::precompute_key() const {
  std::string key;
  // values_ is a map: sorted by name.
  for (const auto& [name, text] : values_)
    if (find_knob(table_, name)->phase == KnobPhase::precompute) key += name + "=" + text + ";";
  return key;
}

}  // namespace relight
