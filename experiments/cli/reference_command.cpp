// relight reference
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/reference_run/reference_run.h"

namespace relight::cli {

void add_reference_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "reference",
      "The path tracer alone: direct, indirect and total light, the variance of the indirect light (EXR), "
      "light by path class (--layers), its noise floor (reference.json) and convergence (convergence.csv). "
      "What an earlier run with the same settings left in --out is gone on with: after an interruption, or "
      "for "
      "more samples.");
  const auto options = std::make_shared<ReferenceOptions>();
  add_session_flags(*command, options->session);
  command
      ->add_option(
          "--bounces", options->bounces,
          "Bounces of indirect light; 0: also what lights with an area and the environment send straight to "
          "visible surfaces. Other direct light is always there")
      ->type_name("A..B")
      ->capture_default_str();
  command
      ->add_option(
          "--glossy", options->glossy,
          "Where indirect light may be reflected glossily: nowhere, at the visible surface, everywhere")
      ->type_name("none|eye|all")
      ->capture_default_str();
  command
      ->add_option(
          "--paths", options->paths,
          "Light paths that make up the picture, in Heckbert's notation from the eye to the light: E, "
          "then vertices D (diffuse), G (glossy), . (either) with *, +, ?, {n,m}, (a|b), then L (any "
          "light), Lp (omni, spot, directional), La (with an area) or Le (environment); for example "
          "'E D D L', 'E .* Lp'")
      ->type_name("PATTERN");
  command->add_flag("--layers", options->layers,
                    "Also write each path class, as layers of layers.exr and layers_variance.exr");
  command
      ->add_option("--class-bounces", options->class_bounces,
                   "Tell path classes apart up to this many bounces; one class holds all longer paths")
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Indirect paths a pixel")->capture_default_str();
  command
      ->add_option(
          "--batch", options->batch,
          "Paths a pixel between two looks at time, error and checkpoint; variance comes from the spread "
          "of batches")
      ->capture_default_str();
  command
      ->add_option("--target-error", options->target_percent,
                   "Stop at this relative standard error of the picture, in per cent; 0: none")
      ->type_name("PERCENT")
      ->capture_default_str();
  command->add_flag("--restart", options->restart, "Start anew, whatever an earlier run left in --out");
  command->add_option("--estimator", options->estimator, "How paths are sampled")
      ->type_name("next_event|light_vertex")
      ->capture_default_str();
  command
      ->add_option(
          "--time", options->time_limit_s,
          "Stop after this many seconds (whole batches), those of earlier sessions in --out included; 0: no "
          "limit")
      ->type_name("SECONDS")
      ->capture_default_str();
  command
      ->add_option("--checkpoint-seconds", options->checkpoint_s,
                   "Write what an interrupted run goes on from after batches that end this much after the "
                   "last time, and at the end; 0: after every batch")
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the images")->required()->type_name("DIR");
  command->callback([&action, options] {
    action = [options] {
      fmt::print("{}", run_reference(*options));
      return 0;
    };
  });
}

}  // namespace relight::cli
