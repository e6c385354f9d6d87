// relight tune
#include <memory>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/tune/tune.h"

namespace relight::cli {

namespace {

constexpr const char* lesson =
    "Starts from the methods' defaults and presets, steps one knob after the other (those that need no new "
    "precompute "
    "first) while that makes the setting better, then exchanges a step of one knob for one of another. The "
    "error must "
    "keep its bound with the whole 95 % interval of the reference's noise. The choice is then measured under "
    "lightings "
    "that the search did not see.\n\n"
    "A search that was killed goes on with the same command: what OUT/records.jsonl holds is not measured "
    "again. "
    "Exit code 1 if no setting keeps the bounds, or the choice misses the error under a lighting that was "
    "not searched.\n\n"
    "Example: relight tune --scene cornell --lights omni --view 160x120 --error 2% --method "
    "direct_to_indirect "
    "--out out/tune. See docs/tune.md";

int run(const TuneOptions& options) {
  const MethodList methods = make_all_methods();
  const TunePlan plan = make_tune_plan(options, methods);
  const TuneResult result = tune(plan);
  write_text_atomically(plan.out / "tune.csv", tune_csv(plan, result));
  write_text_atomically(plan.out / "tune.json", tune_json(plan, result));
  write_text_atomically(plan.out / "tune.md", tune_markdown(plan, result));
  fmt::print("{}\ntables  {}\nrecords {}\n", tune_text(plan, result),
             (plan.out / "tune.{csv,json,md}").string(), (plan.out / "records.jsonl").string());
  return result.keeps_bounds && result.all_met() ? 0 : 1;
}

void add_bound_flags(Command& command, TuneOptions& options) {
  command.add_option("--error", options.error, "Largest error allowed, e.g. 0.05 or 5%")
      ->required()
      ->type_name("SHARE");
  command
      .add_option("--metric", options.metric,
                  "Which error: relative, relative_edges_out, or indirect light alone")
      ->type_name("relative|relative_edges_out|indirect")
      ->capture_default_str();
  command.add_option("--relight-ms", options.relight_ms, "Longest relight allowed [ms]")->type_name("T");
  command.add_option("--memory", options.memory_mb, "Largest sum of the method's data allowed [MB]")
      ->type_name("M");
  command.add_option("--precompute-s", options.precompute_s, "Longest precompute allowed [s]")
      ->type_name("P");
  command
      .add_option("--minimise", options.minimise, "What should be cheapest: relight, memory or precompute")
      ->type_name("COST")
      ->capture_default_str();
}

void add_search_flags(Command& command, TuneOptions& options) {
  command.add_option("--method", options.methods, "Method to tune; may be repeated (default: all)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      .add_option("--set", options.settings, "Value of a knob that the search leaves alone; may be repeated")
      ->type_name("METHOD.KNOB=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--verify-lights", options.verify_lights,
                  "Lightings that the choice is verified under, comma-separated presets or files (default: "
                  "the scene's "
                  "others, and generated lamps if they are fewer than three)")
      ->type_name("A,B");
  command.add_option("--budget-s", options.budget_s, "Time of the search, verification apart [s]")
      ->capture_default_str();
  command.add_option("--runs", options.runs, "Settings tried at most, all methods together")
      ->capture_default_str();
  command
      .add_option("--reference-samples", options.reference_samples, "Indirect paths a pixel of the reference")
      ->capture_default_str();
  command
      .add_option("--repeats", options.repeats,
                  "Timed relights of each setting; 0: five, fewer if they are slow")
      ->capture_default_str();
  command.add_option("--out", options.out, "Folder for records and tables")
      ->type_name("DIR")
      ->capture_default_str();
}

}  // namespace

void add_tune_command(Command& app, Action& action) {
  Command* command = app.add_subcommand("tune",
                                        "Finds the cheapest setting that keeps an error, and verifies it "
                                        "under lights that the search did not see");
  command->footer(lesson);
  const auto options = std::make_shared<TuneOptions>();
  add_session_flags(*command, options->session);
  add_bound_flags(*command, *options);
  add_search_flags(*command, *options);
  command->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace relight::cli
