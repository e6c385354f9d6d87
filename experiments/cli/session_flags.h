// The options that render, reference and compare share.
#pragma once

#include <string>
#include <vector>

#include "experiments/cli/command.h"
#include "experiments/compare/plan.h"
#include "experiments/session/options.h"

namespace relight::cli {

void add_session_flags(Command& command, SessionOptions& options);
// Of them, those that say how a machine is used: threads, gpu, cache, quiet.
void add_machine_flags(Command& command, SessionOptions& options);
// --preset and --set.
void add_knob_flags(Command& command, std::string& preset, std::vector<std::string>& settings);
// --tolerance and --effect.
void add_effect_flags(Command& command, EffectOptions& options);
// --cache and --no-cache alone.
void add_cache_folder_flag(Command& command, SessionOptions& options);

}  // namespace relight::cli
