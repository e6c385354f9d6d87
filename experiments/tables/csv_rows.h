// Rows of a CSV by the names of their columns.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace relight::tables {

using CsvRow = std::map<std::string, std::string>;

// RFC 4180; the first line names the columns. Throws Error naming `name` and the row if a row has more or
// fewer cells than there are columns.
std::vector<CsvRow> csv_rows(const std::string& text, const std::string& name);

}  // namespace relight::tables
