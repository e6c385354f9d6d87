// The subcommands of the program, one file each. A subcommand declares its options on the parser and, when it
// was chosen, sets `action` to what should run once parsing has succeeded.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace relight::cli {

// Returns the exit code; throws UsageError (2) or Error (1).
using Action = std::function<int()>;

void add_scene_command(CLI::App& app, Action& action);
void add_methods_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_plan_command(CLI::App& app, Action& action);
void add_reference_command(CLI::App& app, Action& action);
void add_references_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_explain_error_command(CLI::App& app, Action& action);
void add_hard_cases_command(CLI::App& app, Action& action);
void add_run_command(CLI::App& app, Action& action);
void add_regress_command(CLI::App& app, Action& action);
void add_publish_command(CLI::App& app, Action& action);
void add_tune_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_cache_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);

}  // namespace relight::cli
