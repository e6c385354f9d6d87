// relight report DIR
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "experiments/cli/commands.h"
#include "experiments/report/report.h"
#include "experiments/usage_error.h"

namespace relight::cli {

void add_report_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("report", "Makes index.html again from the records and images of a comparison");
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Folder that `relight compare --out` wrote")
      ->required()
      ->type_name("DIR");
  command->callback([&action, folder] {
    action = [folder] {
      if (!std::filesystem::is_directory(*folder)) usage_fail("'{}' is not a folder", *folder);
      write_report(*folder);
      fmt::print("{}\n", (std::filesystem::path(*folder) / "index.html").string());
      return 0;
    };
  });
}

}  // namespace relight::cli
