// The sections of the page, each a piece of HTML made from the records alone (or, for the pictures, from the
// images).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"

namespace relight::report {

using Records = std::vector<RunRecord>;

std::string results_section(const Records& records);  // errors beside their noise floor, times, bytes
std::string paths_section(const Records& records);    // what was compared and what was left out
std::string effects_section(
    const Records& records);  // what the effect planner left out; empty without a plan
std::string pictures_section(const Records& records, const std::filesystem::path& folder);
// Interactive comparison of the same pictures; empty if there is nothing to compare.
std::string viewer_section(const Records& records, const std::filesystem::path& folder);
std::string times_section(const Records& records);     // stage bars, counters, bytes
std::string settings_section(const Records& records);  // resolved knobs and commands
std::string origin_section(const Records& records, const std::vector<std::string>& unreadable);

extern const char* const style_sheet;
extern const char* const script;
extern const char* const viewer_script;  // of viewer_section

}  // namespace relight::report
