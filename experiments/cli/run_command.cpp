// relight run
#include <cstdio>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/compare/compare.h"
#include "experiments/experiment_page/experiment_page.h"
#include "experiments/run/explain_runs.h"
#include "experiments/run/run_experiment.h"
#include "experiments/run/workers.h"
#include "experiments/session/output_folder.h"

namespace relight::cli {

namespace {

// Keeps the runs whose description contains `text`.
void keep_only(RunList& list, const std::string& text) {
  std::erase_if(list.runs,
                [&](const PlannedRun& run) { return describe(run).find(text) == std::string::npos; });
}

void keep_place(RunList& list, size_t place) {
  const std::vector<size_t> numbers = place_numbers(list);
  RunList kept;
  for (size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] == place) kept.runs.push_back(std::move(list.runs[i]));
  list = std::move(kept);
}

int dry_run(const RunOptions& options, const RunList& list, const std::filesystem::path& out) {
  const std::vector<bool> done =
      options.again ? std::vector<bool>(list.runs.size(), false) : done_runs(list, out);
  fmt::print("\n{}", plan_text(list.runs, done, forecasts_for(list, out)));
  if (const size_t n = runs_to_explain(list, out, options.again).size(); n > 0)
    fmt::print("errors to take apart (explain_pixels): {}, minutes each, not in the time above\n", n);
  return 0;
}

// One of the processes of --jobs: silent but for progress on standard error.
int run_as_worker(RunList list, const std::filesystem::path& out, const RunOptions& options) {
  keep_place(list, static_cast<size_t>(options.place));
  return run_experiment(list, out, options.again, true).failures.empty() ? 0 : 1;
}

int run(RunOptions options) {
  const MethodList methods = make_all_methods();
  Experiment experiment = read_experiment(options.experiment);
  if (options.time_limit_s >= 0.0) experiment.time_limit_s = options.time_limit_s;
  const std::filesystem::path out = options.out.empty() ? "out/" + experiment.name : options.out;
  options.session.shared_machine = options.place >= 0;
  RunList list = make_runs(experiment, options.session, methods, out);
  if (!options.only.empty()) keep_only(list, options.only);
  if (options.place >= 0) return run_as_worker(std::move(list), out, options);
  std::set<std::string> views;
  for (const PlannedRun& run : list.runs) views.insert(run.plan.session.view);
  fmt::print("{}: {}\n{} runs, view {}\n", experiment.name, experiment.title, list.runs.size(),
             fmt::join(views, ", "));
  for (const std::string& left_out : list.left_out) fmt::print("left out: {}\n", left_out);
  if (options.dry_run) return dry_run(options, list, out);
  std::fflush(stdout);  // before others write
  require_writable_folder("--out", out);
  // Before the runs: a page made after a kill has its title too.
  write_description(out, {experiment.name, experiment.title, list.left_out, experiment.paper_numbers});
  ExperimentResult result =
      options.jobs > 1 ? run_in_workers(options, list, out) : run_experiment(list, out, options.again);
  for (std::string& failure : explain_runs(list, runs_to_explain(list, out, options.again), out))
    result.failures.push_back(std::move(failure));
  if (std::filesystem::exists(out / "records.jsonl"))
    fmt::print("{}", write_experiment_page(out, RunPages::missing));
  fmt::print("\npage    {}\nrecords {}\ntable   {}\nimages  {}\n", (out / "index.html").string(),
             (out / "records.jsonl").string(), (out / "table.csv").string(), (out / "*" / "*.exr").string());
  for (const std::string& failure : result.failures) fmt::print("FAILED  {}\n", failure);
  return result.failures.empty() ? 0 : 1;
}

}  // namespace

void add_run_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
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
  command->add_flag(
      "--dry-run", options->dry_run,
      "Check every name, list the runs with the time and bytes that earlier records let expect, "
      "and stop");
  command
      ->add_option(
          "--time-limit", options->time_limit_s,
          "Seconds that a method may take for a run: effect plan, precompute and relights together, "
          "not the reference. A run over it fails, the others go on. Asked at the beginning of every "
          "stage and whenever progress is reported, so it ends somewhat later. In place of the file's "
          "time_limit_s; 0: none")
      ->type_name("SECONDS")
      ->non_negative();
  command->add_flag("--again", options->again, "Also runs that were done before");
  command
      ->add_option(
          "--jobs", options->jobs,
          "Processes at a time, each with the runs of one scene and lighting. Errors and counters are the "
          "same; times are those of a machine that had more to do: records are marked shared_machine and "
          "their times are not compared (docs/experiments.md)")
      ->within(1, 64)
      ->capture_default_str();
  command->add_option("--place", options->place)->hidden();  // how --jobs starts its processes
  add_machine_flags(*command, options->session);
  command->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace relight::cli
