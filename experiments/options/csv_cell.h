// A cell of a CSV file (RFC 4180).
#pragma once

#include <string>

namespace relight {

// In quotes if it holds a comma, a quote or a line break.
std::string csv_cell(const std::string& text);

}  // namespace relight
