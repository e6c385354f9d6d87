// The page of a comparison: one self-contained HTML file made from records and the EXR images beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/run_record.h"

namespace relight {

// Writes folder/index.html from folder/records.jsonl. Throws Error if there is no readable record or the page
// can't be written. Images that are missing leave a note in their place.
void write_report(const std::filesystem::path& folder);

// The same of given records, of which there must be one at least. `home`: address of the page that this one
// belongs to; empty: none.
void write_report(const std::filesystem::path& folder, const std::vector<RunRecord>& records,
                  const std::string& home);

}  // namespace relight
