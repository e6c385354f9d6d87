#include "stable_record.h"

#include <cstring>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "program.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Names of the stages in their order, without those of the cache.
json stage_names(const json& stages) {
  json names = json::array();
  for (const auto& [name, seconds] : stages.items())
    if (name.rfind("cache_", 0) != 0) names.push_back(name);
  return names;
}

std::set<fs::path> images_below(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".exr") files.insert(fs::relative(entry.path(), folder));
  return files;
}

}  // namespace

json stable_part(json record, const std::string& out) {
  json stages;
  for (const auto& [phase, of_phase] : record.at("time").at("stages").items())
    stages[phase] = stage_names(of_phase);
  record["time"] = {{"repeats", record.at("time").at("relight_ms").at("repeats")}, {"stages", stages}};
  record.at("memory_bytes").erase("process_peak");
  record.at("counters").erase("cache_hits");
  record.at("provenance").erase("date");
  if (record.contains("reference"))
    for (const char* key : {"seconds", "from_cache"}) record["reference"].erase(key);
  std::string command = record.at("command").get<std::string>();
  if (const size_t at = command.find(out); at != std::string::npos) command.replace(at, out.size(), "OUT");
  record["command"] = command;
  return record;
}

std::vector<json> stable_records(const fs::path& out) {
  std::istringstream lines(read_text(out / "records.jsonl"));
  std::vector<json> records;
  for (std::string line; std::getline(lines, line);)
    if (const json record = json::parse(line, nullptr, false); !record.is_discarded())
      records.push_back(stable_part(record, out.string()));
  return records;
}

void expect_same_images(const fs::path& a, const fs::path& b) {
  const std::set<fs::path> files = images_below(a);
  EXPECT_EQ(files, images_below(b));
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const Image one = read_exr(a / file), other = read_exr(b / file);
    ASSERT_EQ(one.pixels.size(), other.pixels.size()) << file;
    EXPECT_EQ(std::memcmp(one.pixels.data(), other.pixels.data(), one.pixels.size() * sizeof(glm::vec3)), 0)
        << file;
  }
}

}  // namespace relight::test
