// relight compare
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/compare/compare.h"

namespace relight::cli {

namespace {

int run_compare(const CompareOptions& options) {
  const MethodList methods = make_all_methods();
  const ComparePlan plan = make_plan(options, methods);
  const std::vector<RunRecord> records = compare(plan);
  fmt::print("{}\nreport  {}\nimages  {}\nrecords {}\n", summary_text(records),
             (plan.out / "index.html").string(), (plan.out / "*.exr").string(),
             (plan.out / "records.jsonl").string());
  for (const RunRecord& record : records) {
    if (!record.failed_stages.empty()) return 1;
  }
  return 0;
}

}  // namespace

void add_compare_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "compare",
      "Runs methods on one scene, view and lighting and measures each against the path-traced reference "
      "restricted to its own light paths. Writes images (EXR), records.jsonl and index.html, replacing those "
      "of an earlier comparison in the same folder");
  const auto options = std::make_shared<CompareOptions>();
  add_session_flags(*command, options->session);
  command->add_option("--methods", options->methods, "Methods, separated by commas (see `relight methods`)")
      ->required()
      ->type_name("NAME,NAME");
  add_knob_flags(*command, options->preset, options->settings);
  add_effect_flags(*command, options->effects);
  command->add_flag(
      "--check-effects", options->effects.check,
      "With --tolerance: also run every method with all its effects on, to tell what the plan saves");
  command->add_option("--out", options->out, "Folder for images, records and the page")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--bounces", options->bounces,
                   "Bounces of indirect light in the reference, in place of each method's own")
      ->type_name("A..B");
  command
      ->add_option("--reference-samples", options->reference_samples,
                   "Indirect paths a pixel of the reference")
      ->capture_default_str();
  command
      ->add_option("--reference-estimator", options->reference_estimator, "How the reference samples paths")
      ->type_name("next_event|light_vertex")
      ->capture_default_str();
  command
      ->add_option("--repeats", options->repeats,
                   "Timed relights after one to warm up; 0: five, fewer if they would take over 20 s")
      ->capture_default_str();
  command->callback([&action, options] { action = [options] { return run_compare(*options); }; });
}

}  // namespace relight::cli
