// A table in plain text: columns as wide as their widest cell.
#pragma once

#include <string>
#include <vector>

namespace relight {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  // Cells beyond the header's number of columns are an error (std::logic_error).
  void add_row(std::vector<std::string> cells);
  // `right_from`: columns from this one on are aligned to the right (numbers).
  std::string to_string(size_t right_from = SIZE_MAX) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace relight
