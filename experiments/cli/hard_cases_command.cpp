// relight hard-cases
#include <memory>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "experiments/cli/commands.h"
#include "experiments/hard_cases/run_hard_cases.h"
#include "experiments/session/output_folder.h"

namespace relight::cli {

namespace {

struct HardCaseOptions {
  std::string out = "out/hard_cases", only_text;
  bool list = false, quiet = false;
};

int run(const HardCaseOptions& options) {
  std::vector<HardCase> cases = all_hard_cases();
  if (!options.only_text.empty()) cases = only(cases, options.only_text);
  if (options.list) {
    for (const HardCase& c : cases) fmt::print("{}: {}\n", title(c), c.of.breaks);
    return 0;
  }
  const std::filesystem::path out = options.out;
  require_writable_folder("--out", out);
  const auto outcomes = run_hard_cases(cases, options.quiet);
  const Provenance provenance = collect_provenance("", "");
  write_text_atomically(out / "hard_cases.csv", hard_cases_csv(outcomes));
  write_text_atomically(out / "hard_cases.json", hard_cases_json(outcomes, provenance));
  write_text_atomically(out / "hard_cases.md", hard_cases_markdown(outcomes, provenance));
  write_text_atomically(out / "index.html", hard_cases_html(outcomes, provenance));
  fmt::print("{}page    {}\ntables  {}\n", hard_cases_text(outcomes), (out / "index.html").string(),
             (out / "hard_cases.{csv,json,md}").string());
  return broken(outcomes) == 0 ? 0 : 1;
}

}  // namespace

void add_hard_cases_command(Command& app, Action& action) {
  Command* command = app.add_subcommand("hard-cases",
                                        "Runs the named hard cases of every method and of the reference: "
                                        "what could break, what was measured, and "
                                        "whether its bound holds");
  command->footer(
      "Exit code 1 if a bound is broken. The tests run the same list. Example: relight hard-cases --only "
      "spot. See "
      "docs/hard_cases.md");
  const auto options = std::make_shared<HardCaseOptions>();
  command->add_option("--out", options->out, "Folder for index.html and hard_cases.csv, .json and .md")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--only", options->only_text, "Only cases whose title (owner: name) contains this text")
      ->type_name("TEXT");
  command->add_flag("--list", options->list, "Lists the cases, and stops");
  command->add_flag("--quiet", options->quiet, "No progress on standard error");
  command->callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace relight::cli
