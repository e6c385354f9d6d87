// The subcommands of the program, one file each. A subcommand declares its options on the parser and, when it
// was chosen, sets `action` to what should run once parsing has succeeded.
#pragma once

#include <functional>

#include "experiments/cli/command.h"

namespace relight::cli {

// Returns the exit code; throws UsageError (2) or Error (1).
using Action = std::function<int()>;

void add_scene_command(Command& app, Action& action);
void add_methods_command(Command& app, Action& action);
void add_render_command(Command& app, Action& action);
void add_plan_command(Command& app, Action& action);
void add_reference_command(Command& app, Action& action);
void add_references_command(Command& app, Action& action);
void add_compare_command(Command& app, Action& action);
void add_explain_error_command(Command& app, Action& action);
void add_hard_cases_command(Command& app, Action& action);
void add_run_command(Command& app, Action& action);
void add_regress_command(Command& app, Action& action);
void add_publish_command(Command& app, Action& action);
void add_tune_command(Command& app, Action& action);
void add_report_command(Command& app, Action& action);
void add_cache_command(Command& app, Action& action);
void add_bench_command(Command& app, Action& action);

}  // namespace relight::cli
