// relight report DIR
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/experiment_page/experiment_page.h"
#include "experiments/report/report.h"
#include "experiments/usage_error.h"

namespace relight::cli {

void add_report_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "report", "Makes the page of a comparison or of an experiment again, from its records and images");
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Folder that `relight compare` or `relight run` wrote")
      ->required()
      ->type_name("DIR");
  command->callback([&action, folder] {
    action = [folder] {
      if (!std::filesystem::is_directory(*folder)) usage_fail("'{}' is not a folder", *folder);
      if (is_experiment_folder(*folder))
        write_experiment_page(*folder, RunPages::all);
      else
        write_report(*folder);
      fmt::print("{}\n", (std::filesystem::path(*folder) / "index.html").string());
      return 0;
    };
  });
}

}  // namespace relight::cli
