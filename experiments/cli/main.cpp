// The relight program: parses, dispatches to one subcommand, and turns errors into exit codes.
// 0 = success, 1 = something failed (a broken file, a method that failed), 2 = a mistake on the command line.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "experiments/cli/commands.h"
#include "experiments/options/parse.h"
#include "experiments/usage_error.h"

namespace {

using relight::cli::Action;

// The innermost subcommand reached: its options are the valid ones.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.front());
}

std::string path_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : path_of(*app.get_parent()) + " " + app.get_name();
}

void print_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = innermost(app);
  std::string valid;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    relight::append_name(valid, sub->get_name());
  }
  const char* kind = valid.empty() ? "options" : "commands";
  if (valid.empty()) {
    for (const CLI::Option* option : command.get_options()) {
      relight::append_name(valid, option->get_name());
    }
  }
  fmt::print(stderr, "{}: {}\nvalid {}: {}\nsee `{} --help`\n", path_of(command), error.what(), kind, valid,
             path_of(command));
}

int run(int argc, char** argv) {
  CLI::App app(
      "Compares relighting algorithms against a path-traced reference: how wrong is each, what did that "
      "accuracy cost, and which light paths does it leave out?",
      "relight");
  app.require_subcommand(1);
  relight::cli::Command root(app);
  Action action;
  relight::cli::add_scene_command(root, action);
  relight::cli::add_methods_command(root, action);
  relight::cli::add_render_command(root, action);
  relight::cli::add_plan_command(root, action);
  relight::cli::add_reference_command(root, action);
  relight::cli::add_references_command(root, action);
  relight::cli::add_compare_command(root, action);
  relight::cli::add_explain_error_command(root, action);
  relight::cli::add_hard_cases_command(root, action);
  relight::cli::add_run_command(root, action);
  relight::cli::add_regress_command(root, action);
  relight::cli::add_publish_command(root, action);
  relight::cli::add_tune_command(root, action);
  relight::cli::add_report_command(root, action);
  relight::cli::add_cache_command(root, action);
  relight::cli::add_bench_command(root, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    print_parse_error(app, error);
    return 2;
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  // A limit on file sizes is to be an error of the write, which names the file, not a silent end.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const relight::UsageError& error) {
    fmt::print(stderr, "relight: {}\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "relight: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "relight: {}\n", error.what());
  }
  return 1;
}
