// relight run
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/compare/compare.h"
#include "experiments/experiment_page/experiment_page.h"
#include "experiments/run/run_experiment.h"
#include "experiments/session/output_folder.h"

namespace relight::cli {

namespace {

// Keeps the runs whose description contains `text`.
void keep_only(RunList& list, const std::string& text) {
  std::erase_if(list.runs,
                [&](const PlannedRun& run) { return describe(run).find(text) == std::string::npos; });
}

int run(const RunOptions& options) {
  const MethodList methods = make_all_methods();
  const Experiment experiment = read_experiment(options.experiment);
  const std::filesystem::path out = options.out.empty() ? "out/" + experiment.name : options.out;
  RunList list = make_runs(experiment, options.session, methods, out);
  if (!options.only.empty()) keep_only(list, options.only);
  fmt::print("{}: {}\n{} runs, view {}\n", experiment.name, experiment.title, list.runs.size(),
             experiment.view);
  for (const std::string& left_out : list.left_out) fmt::print("left out: {}\n", left_out);
  if (options.dry_run) {
    for (const PlannedRun& planned : list.runs) fmt::print("  {}\n", describe(planned));
    return 0;
  }
  require_writable_folder("--out", out);
  // Before the runs: a page made after a kill has its title too.
  write_description(out, {experiment.name, experiment.title, list.left_out, experiment.paper_numbers});
  const ExperimentResult result = run_experiment(list, out, options.again);
  if (std::filesystem::exists(out / "records.jsonl"))
    fmt::print("{}", write_experiment_page(out, methods, RunPages::missing));
  fmt::print("\npage    {}\nrecords {}\ntable   {}\nimages  {}\n", (out / "index.html").string(),
             (out / "records.jsonl").string(), (out / "table.csv").string(), (out / "*" / "*.exr").string());
  for (const std::string& failure : result.failures) fmt::print("FAILED  {}\n", failure);
  return result.failures.empty() ? 0 : 1;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "run",
      "Runs an experiment: every combination of scenes, lights, presets, seeds and knob values of a file "
      "(experiments/*.toml). A run that was done before is not done again, so an interrupted experiment goes "
      "on where it stopped");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("experiment", options->experiment, "TOML file")->required()->type_name("FILE");
  command->add_option("--out", options->out, "Folder of records, table and images (default out/<experiment>)")
      ->type_name("DIR");
  command->add_option("--only", options->only, "Only runs whose line in --dry-run contains this text")
      ->type_name("TEXT");
  command->add_flag("--dry-run", options->dry_run, "Check every name, list the runs, and stop");
  command->add_flag("--again", options->again, "Also runs that were done before");
  add_machine_flags(*command, options->session);
  command->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace relight::cli
