// A table for people and spreadsheets, before it is HTML, Markdown or LaTeX.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace relight::tables {

struct TableCell {
  std::string text;
  double value =
      std::numeric_limits<double>::quiet_NaN();  // sorted by and downloaded; not a number: the text is
  std::string style;                             // "best", "failed", "soft" or nothing
  std::string link;                              // relative address
};

inline TableCell text_cell(const std::string& text) { return {text, TableCell{}.value, "", ""}; }

struct TableColumn {
  std::string title;
  bool number = false;  // aligned to the right
};

struct Table {
  std::string name;   // for files and addresses: letters, digits, '_'
  std::string title;  // one sentence
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;
  std::string note;  // below the table
};

std::string markdown(const Table& table);
// With booktabs. Whole document parts: a table environment with caption and label "tab:NAME".
std::string latex(const Table& table);
// {"name", "title", "columns": [text], "rows": [[text or number]]}.
std::string json_text(const Table& table);

}  // namespace relight::tables
