// relight references list | check | update
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/stored_references/commands.h"

namespace relight::cli {

namespace {

void add_names(Command& command, ReferencesOptions& options) {
  command.add_option("names", options.names, "Names of stored references (see `list`); none: all of them")
      ->type_name("NAME...");
}

void add_shared_flags(Command& command, ReferencesOptions& options) {
  command.add_option("--folder", options.folder, "Where the stored references lie")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "No progress on standard error");
}

}  // namespace

void add_references_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "references",
      "The stored reference pictures: what there is, does the path tracer still agree, make them anew");
  command->require_subcommand(1);
  const auto options = std::make_shared<ReferencesOptions>();
  Command* list =
      command->add_subcommand("list", "Every stored reference: scene, lights, samples, error, state");
  Command* check = command->add_subcommand(
      "check",
      "Render afresh with fewer samples and another seed, and test whether the pictures are the same "
      "(exit code 1 if one is not, or is stale)");
  Command* update =
      command->add_subcommand("update", "Render with all samples, store, and print what changed");
  for (Command* sub : {list, check, update}) add_shared_flags(*sub, *options);
  for (Command* sub : {check, update}) add_names(*sub, *options);
  check
      ->add_option("--samples", options->samples_per_batch,
                   "Indirect samples a pixel in each of the 32 renders")
      ->capture_default_str();
  check->add_option("--seed", options->seed, "Seed of the fresh renders")->capture_default_str();
  const auto run = [&action, options](std::string (*function)(const ReferencesOptions&, bool&)) {
    return [&action, options, function] {
      action = [options, function] {
        bool good = true;
        fmt::print("{}", function(*options, good));
        return good ? 0 : 1;
      };
    };
  };
  list->callback(run(list_references));
  check->callback(run(check_references));
  update->callback(run(update_references));
}

}  // namespace relight::cli
