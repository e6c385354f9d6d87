// relight explain-error
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/explain/explain.h"

namespace relight::cli {

namespace {

constexpr const char* lesson =
    "A method is a chain of approximations, each of which has an exact twin that is far too slow for a "
    "picture "
    "but not for a few pixels. On some pixels spread over the view the method runs as asked, then with the "
    "first "
    "approximation made exact, then with the first two, and so on; what the relative error loses from one to "
    "the "
    "next are that stage's points. They add up to the error, because each is a difference of two neighbours; "
    "what "
    "no stage explains is left against the reference.\n\n"
    "Points depend on the order: a stage may hide another's error, or undo it (negative points). So there is "
    "also "
    "'alone', the points of a stage with all others exact, and 'change', how far the stage moves the picture "
    "whichever way. Noise of the reference and the 95 % interval over the choice of pixels are printed: bars "
    "below them say nothing.\n\n"
    "All that depends on the whole view (gather cloud, importance) is that of the whole view. Times are "
    "those of "
    "these pixels, not of a picture.\n\n"
    "Example: relight explain-error --scene colonnade --lights spot --method direct_to_indirect --preset "
    "best "
    "--out out/why; then paper_figs/waterfall.py out/why/waterfall.csv draws it. See docs/explain_error.md";

int run_explain_error(const ExplainOptions& options) {
  const MethodList methods = make_all_methods();
  const ExplainPlan plan = make_explain_plan(options, methods);
  const Explanation explanation = explain(plan);
  write_explanation(explanation, plan.out);
  fmt::print("{}\ntable   {}\ndetails {}\n", waterfall_text(explanation),
             (plan.out / "waterfall.csv").string(), (plan.out / "waterfall.json").string());
  return 0;
}

}  // namespace

void add_explain_error_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "explain-error",
      "Tells which of a method's approximations costs how much of its error, and what each saves");
  command->footer(lesson);
  const auto options = std::make_shared<ExplainOptions>();
  add_session_flags(*command, options->session);
  command->add_option("--method", options->method, "Method (see `relight methods`)")
      ->required()
      ->type_name("NAME");
  add_knob_flags(*command, options->preset, options->settings);
  command
      ->add_option("--pixels", options->pixels,
                   "Pixels to look at; time and memory grow with them (1024 need some gigabytes with all "
                   "coefficients of 65,536 gather samples)")
      ->capture_default_str();
  command
      ->add_option(
          "--block", options->block,
          "Pixels that are chosen together. Small blocks are spread better; 16x8 holds whole tiles of "
          "the GPU's product, whose 8-bit steps and culling then are exactly those of the picture")
      ->type_name("WxH")
      ->capture_default_str();
  command
      ->add_option("--reference-samples", options->reference_samples,
                   "Indirect paths a pixel of the reference")
      ->capture_default_str();
  command
      ->add_option(
          "--repeats", options->repeats,
          "Timed relights of each setting after one to warm up; 0: five, fewer if they would take over "
          "20 s")
      ->capture_default_str();
  command->add_flag("--closer", options->closer,
                    "Also run, all stages exact, what should shrink the rest (larger gather clouds): slow");
  command->add_option("--out", options->out, "Folder for waterfall.csv and waterfall.json")
      ->required()
      ->type_name("DIR");
  command->callback([&action, options] { action = [options] { return run_explain_error(*options); }; });
}

}  // namespace relight::cli
