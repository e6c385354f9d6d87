// What of a record must be the same each time that a run is done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relight::test {

// Without times, dates, the process's memory, and what says whether data came from the cache; `out`, the
// folder in the record's command, is written OUT.
nlohmann::json stable_part(nlohmann::json record, const std::string& out);

// Of each whole line of OUT/records.jsonl; a torn line is left out.
std::vector<nlohmann::json> stable_records(const std::filesystem::path& out);

// Every EXR file below both folders has the same name and the same bits of pixels; says what differs.
void expect_same_images(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace relight::test
