// Checks that an output folder can be written before hours are spent on what should go into it.
#pragma once

#include <filesystem>

#include "common/run/error.h"

namespace relight {

// Results cannot be written (a full disk, a quota): whatever would run next could not be kept either.
class OutputError : public Error {
 public:
  using Error::Error;
};

// Creates the folder if needed and writes and removes a probe file. Throws UsageError naming the option and
// folder.
void require_writable_folder(const std::string& option, const std::filesystem::path& folder);

}  // namespace relight
