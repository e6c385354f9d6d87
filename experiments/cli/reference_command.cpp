// relight reference
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/reference_run/reference_run.h"

namespace relight::cli {

void add_reference_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "reference",
      "The path tracer alone: direct, indirect and total light, the variance of the indirect light (EXR), "
      "and its noise floor (reference.json)");
  const auto options = std::make_shared<ReferenceOptions>();
  add_session_flags(*command, options->session);
  command
      ->add_option("--bounces", options->bounces, "Bounces of indirect light; direct light is always there")
      ->type_name("A..B")
      ->capture_default_str();
  command
      ->add_option(
          "--glossy", options->glossy,
          "Where indirect light may be reflected glossily: nowhere, at the visible surface, everywhere")
      ->type_name("none|eye|all")
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Indirect paths a pixel")->capture_default_str();
  command->add_option("--estimator", options->estimator, "How paths are sampled")
      ->type_name("next_event|light_vertex")
      ->capture_default_str();
  command
      ->add_option("--time", options->time_limit_s,
                   "Stop after this many seconds (whole batches), 0: no limit")
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
