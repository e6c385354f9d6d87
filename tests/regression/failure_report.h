// What a person needs to judge a picture that differs from its reference.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/stored_references/decision.h"

namespace relight::test {

// Writes fresh, reference and difference (fresh - reference; indirect light) as EXR and PNG, the difference
// in standard errors as EXR, and p_values.txt into `folder`. PNG: pictures at `exposure`; differences in
// false colours. Returns a text with the p-values, the folder, and the command that accepts a new reference.
std::string report_failure(const std::filesystem::path& folder, const std::string& name,
                           const PictureStatistics& fresh, const PictureStatistics& stored,
                           const Decision& decision, float exposure);

// Where failing tests write: a folder in the build folder.
inline std::filesystem::path failures_folder() { return RELIGHT_FAILURES; }

}  // namespace relight::test
