// Checks that an output folder can be written before hours are spent on what should go into it.
#pragma once

#include <filesystem>

namespace relight {

// Creates the folder if needed and writes and removes a probe file. Throws UsageError naming the option and
// folder.
void require_writable_folder(const std::string& option, const std::filesystem::path& folder);

}  // namespace relight
