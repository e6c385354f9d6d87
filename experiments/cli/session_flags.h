// The options that render, reference and compare share.
#pragma once

#include <string>
#include <vector>

#include "experiments/compare/plan.h"
#include "experiments/session/options.h"

namespace CLI {
class App;
}

namespace relight::cli {

void add_session_flags(CLI::App& command, SessionOptions& options);
// Of them, those that say how a machine is used: threads, gpu, cache, quiet.
void add_machine_flags(CLI::App& command, SessionOptions& options);
// --preset and --set.
void add_knob_flags(CLI::App& command, std::string& preset, std::vector<std::string>& settings);
// --tolerance and --effect.
void add_effect_flags(CLI::App& command, EffectOptions& options);
// --cache and --no-cache alone.
void add_cache_folder_flag(CLI::App& command, SessionOptions& options);

}  // namespace relight::cli
