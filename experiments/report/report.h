// The page of a comparison: one self-contained HTML file made from records.jsonl and the EXR images beside
// it.
#pragma once

#include <filesystem>

namespace relight {

// Writes folder/index.html. Throws Error if there is no readable record or the page can't be written. Images
// that are missing leave a note in their place.
void write_report(const std::filesystem::path& folder);

}  // namespace relight
