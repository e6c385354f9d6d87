#include "experiments/options/knob_text.h"

#include <fmt/format.h>

#include "experiments/options/text_table.h"

namespace relight {

std::string type_name(const Knob& knob) {
  switch (knob.type) {
    case KnobType::integer:
      return "integer";
    case KnobType::real:
      return "real";
    case KnobType::choice:
      return "choice";
    case KnobType::boolean:
      return "boolean";
  }
  return "";
}

std::string range_text(const Knob& knob) {
  if (knob.type == KnobType::boolean) return "true|false";
  if (knob.type != KnobType::choice) return fmt::format("{}..{}", knob.min, knob.max);
  return fmt::format("{}", fmt::join(knob.choices, "|"));
}

std::string phase_name(const Knob& knob) {
  return knob.phase == KnobPhase::precompute ? "precompute" : "relight";
}

std::string knob_table_text(const KnobTable& table) {
  TextTable text({"knob", "type", "default", "range", "phase", "stage", "what it does"});
  for (const Knob& knob : table) {
    text.add_row({knob.name, type_name(knob), knob.default_value, range_text(knob), phase_name(knob),
                  knob.stage, knob.help});
  }
  return text.to_string();
}

std::string presets_text(const std::vector<KnobPreset>& presets) {
  TextTable text({"--preset", "sets", "what it is"});
  text.add_row({"paper", "", "The defaults."});
  for (const KnobPreset& preset : presets) {
    std::string values;
    for (const auto& [knob, value] : preset.values)
      values += fmt::format("{}{}={}", values.empty() ? "" : " ", knob, value);
    text.add_row({preset.name, values, preset.help});
  }
  return text.to_string();
}

}  // namespace relight
