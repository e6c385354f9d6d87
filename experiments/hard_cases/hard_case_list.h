// Every list of hard cases, by who owns it.
#pragma once

#include <string>
#include <vector>

#include "common/hard_cases/hard_case.h"

namespace relight {

struct HardCase {
  std::string owner;  // "clustered_gather"
  hard::Case of;
};

// In the order of registration and of the lists.
std::vector<HardCase> all_hard_cases();

// "owner: name".
std::string title(const HardCase& hard_case);

// Those whose title contains `text`. Throws UsageError listing the titles if there is none.
std::vector<HardCase> only(const std::vector<HardCase>& cases, const std::string& text);

}  // namespace relight
