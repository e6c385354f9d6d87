// Knob tables for people: one source for `relight methods NAME`, `--help` and the report.
#pragma once

#include <string>

#include "common/run/knobs.h"

namespace relight {

std::string type_name(const Knob& knob);   // "integer", "real", "boolean", "choice"
std::string range_text(const Knob& knob);  // "1024..1048576", "map|traced", "true|false"
std::string phase_name(const Knob& knob);  // "precompute", "relight"

// One aligned line a knob: name, type, default, range, phase, stage, sentence.
std::string knob_table_text(const KnobTable& table);

// One line a preset with the knobs that it sets, "paper" first.
std::string presets_text(const std::vector<KnobPreset>& presets);

}  // namespace relight
