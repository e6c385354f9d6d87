// relight regress, relight publish
#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "experiments/cli/commands.h"
#include "experiments/options/parse.h"
#include "experiments/regress/publish.h"
#include "experiments/regress/regress.h"
#include "experiments/stored_references/commands.h"
#include "experiments/usage_error.h"

namespace relight::cli {

namespace {

namespace fs = std::filesystem;

struct RegressOptions {
  std::vector<std::string> folders;  // of fresh runs; empty: out/NAME of every published NAME
  std::string results = "results";
  std::string references;  // names, or "all"; empty: not checked
  std::string html;
  Tolerances tolerances;
};

bool has_records(const fs::path& folder) { return fs::is_regular_file(folder / "records.jsonl"); }

std::vector<std::string> published_names(const fs::path& results) {
  std::vector<std::string> names;
  if (!fs::is_directory(results)) usage_fail("--results '{}': no such folder", results.string());
  for (const auto& entry : fs::directory_iterator(results))
    if (has_records(entry.path())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  if (names.empty())
    usage_fail("--results '{}': no folder with a records.jsonl; `relight publish` makes one",
               results.string());
  return names;
}

// RESULTS/NAME, or RESULTS itself if it holds records.
fs::path published_folder(const fs::path& results, const std::string& name) {
  return has_records(results) ? results : results / name;
}

Regression regress_one(const fs::path& fresh_folder, const RegressOptions& options) {
  const std::string name =
      fs::absolute(fresh_folder / "").lexically_normal().parent_path().filename().string();
  std::vector<std::string> notes;
  const auto published = read_results(published_folder(options.results, name), notes);
  std::vector<RunRecord> fresh;
  if (has_records(fresh_folder))
    fresh = read_results(fresh_folder, notes);
  else
    notes.push_back(fmt::format("not run: '{}' does not exist; run the experiment first",
                                (fresh_folder / "records.jsonl").string()));
  const std::string commit = collect_provenance("", "").commit;
  if (std::any_of(fresh.begin(), fresh.end(),
                  [&](const RunRecord& r) { return r.provenance.commit != commit; }))
    notes.push_back("the fresh runs were made by another build than this program's");
  Regression regression = compare_results(name, published, fresh, options.tolerances);
  regression.notes.insert(regression.notes.begin(), notes.begin(), notes.end());
  return regression;
}

std::string check_pictures(const std::string& names, bool& good) {
  ReferencesOptions options;
  if (names != "all") options.names = parse_name_list("--references", names);
  return check_references(options, good);
}

int regress(const RegressOptions& options) {
  if (!(options.tolerances.time >= 1.0))
    usage_fail("--time-tolerance {}: expected a factor from 1", options.tolerances.time);
  std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  if (folders.empty())
    for (const std::string& name : published_names(options.results))
      folders.push_back(fs::path("out") / name);
  else
    for (const fs::path& folder : folders)
      if (!has_records(folder))
        usage_fail("'{}': no records.jsonl in it; `relight run EXPERIMENT` writes one", folder.string());
  bool good = true;
  std::vector<Regression> regressions;
  for (const fs::path& folder : folders) {
    regressions.push_back(regress_one(folder, options));
    fmt::print("{}\n", regression_text(regressions.back()));
    good = good && regressions.back().good();
  }
  const std::string pictures = options.references.empty() ? "" : check_pictures(options.references, good);
  if (pictures.empty())
    fmt::print("stored reference pictures: not checked (--references all)\n");
  else
    fmt::print("stored reference pictures\n{}", pictures);
  if (!options.html.empty()) {
    write_text_atomically(options.html, regression_page(regressions, pictures));
    fmt::print("page {}\n", options.html);
  }
  fmt::print("{}\n", good ? "SAME" : "CHANGED");
  return good ? 0 : 1;
}

}  // namespace

void add_regress_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "regress",
      "Compares fresh runs of experiments with the published results: errors beyond their intervals, "
      "counters "
      "and bytes that changed, times by ratio on the same machine, runs that are missing or new "
      "(docs/regress.md). Exit code 0: nothing changed, 1: something did or is missing, 2: a mistake on the "
      "command line");
  const auto options = std::make_shared<RegressOptions>();
  command
      ->add_option("folders", options->folders,
                   "Folders that `relight run` wrote (default: out/NAME for each NAME in --results)")
      ->type_name("DIR...");
  command
      ->add_option(
          "--results", options->results,
          "Published results: NAME/records.jsonl below it, NAME being the name of the fresh folder; or "
          "a folder with records.jsonl itself")
      ->type_name("DIR")
      ->capture_default_str();
  command
      ->add_option("--time-tolerance", options->tolerances.time,
                   "A time is longer if median and fastest repeat both are by more than this factor")
      ->type_name("FACTOR")
      ->capture_default_str();
  command
      ->add_option("--references", options->references,
                   "Check stored reference pictures too: names, or all (minutes; see `relight references`)")
      ->type_name("NAME,...|all");
  command->add_option("--html", options->html, "Writes the comparison as a page")->type_name("FILE");
  command->callback([&action, options] { action = [options] { return regress(*options); }; });
}

void add_publish_command(Command& app, Action& action) {
  Command* command =
      app.add_subcommand("publish",
                         "Keeps the results of an experiment in a small form to be committed: records.jsonl "
                         "without what belongs to the machine's folders, and table.csv");
  const auto folders = std::make_shared<std::pair<std::string, std::string>>();
  command->add_option("from", folders->first, "Folder that `relight run` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("to", folders->second, "Folder below results/")->required()->type_name("DIR");
  command->callback([&action, folders] {
    action = [folders] {
      fmt::print("{}", publish(folders->first, folders->second));
      return 0;
    };
  });
}

}  // namespace relight::cli
