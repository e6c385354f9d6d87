#include "experiments/regress/publish.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "experiments/regress/regress.h"
#include "experiments/run/run_experiment.h"

namespace relight {
namespace {

using Json = nlohmann::ordered_json;

void round_numbers(Json& json) {
  if (json.is_number_float())
    json = std::strtod(fmt::format("{:.7g}", json.get<double>()).c_str(), nullptr);
  else if (json.is_structured())
    for (Json& value : json) round_numbers(value);
}

// What explain_pixels, or explain-error by hand, left in the folders of runs. Returns how many.
size_t publish_waterfalls(const std::filesystem::path& from, const std::filesystem::path& to) {
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(from)) {
    std::ifstream in(entry.path() / "waterfall.csv", std::ios::binary);
    if (!entry.is_directory() || !in) continue;
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    write_text_atomically(to / "waterfalls" / (entry.path().filename().string() + ".csv"), text);
    ++count;
  }
  return count;
}

}  // namespace

std::string published_line(const RunRecord& record) {
  RunRecord slim = record;
  slim.command.clear();
  slim.warnings.clear();
  Json json = Json::parse(record_to_json(slim));
  round_numbers(json);
  return json.dump();
}

std::string publish(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::vector<std::string> notes;
  const std::vector<RunRecord> records = read_results(from, notes);
  if (records.empty()) fail("'{}' holds no record", (from / "records.jsonl").string());
  std::string lines;
  size_t failed = 0, without_commit = 0, shared = 0;
  for (const RunRecord& record : records) {
    lines += published_line(record) + "\n";
    failed += record.failed_stages.empty() ? 0 : 1;
    without_commit += record.provenance.dirty || record.provenance.commit.size() != 40 ? 1 : 0;
    shared += record.provenance.shared_machine ? 1 : 0;
  }
  write_text_atomically(to / "records.jsonl", lines);
  write_text_atomically(to / "table.csv", result_csv(records));
  const size_t waterfalls = publish_waterfalls(from, to);
  std::string text = fmt::format("{} runs published in {}\n", records.size(), to.string());
  if (waterfalls > 0) text += fmt::format("{} waterfalls of their errors in waterfalls/\n", waterfalls);
  const auto warn = [&](size_t count, const char* why) {
    if (count > 0) text += fmt::format("warning: {} of them {}\n", count, why);
  };
  warn(failed, "failed");
  warn(without_commit, "were made by a build that is no commit: nobody can build it again");
  warn(shared, "shared the machine with other runs: their times will not be compared");
  for (const std::string& note : notes) text += "warning: " + note + "\n";
  return text;
}

}  // namespace relight
