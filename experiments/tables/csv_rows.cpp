#include "experiments/tables/csv_rows.h"

#include "common/run/error.h"

namespace relight::tables {
namespace {

std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
  std::string cell;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      cell += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (quoted)
      cell += c;
    else if (c == ',')
      row.push_back(std::move(cell)), cell.clear();
    else if (c == '\n') {
      row.push_back(std::move(cell)), cell.clear();
      rows.push_back(std::move(row)), row.clear();
    } else if (c != '\r')
      cell += c;
  }
  if (!cell.empty() || !row.empty()) row.push_back(std::move(cell)), rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::vector<CsvRow> csv_rows(const std::string& text, const std::string& name) {
  const auto cells = cells_of(text);
  std::vector<CsvRow> rows;
  for (size_t i = 1; i < cells.size(); ++i) {
    if (cells[i].size() != cells[0].size())
      fail("{}, row {}: {} cells; expected {}", name, i + 1, cells[i].size(), cells[0].size());
    CsvRow row;
    for (size_t c = 0; c < cells[i].size(); ++c) row[cells[0][c]] = cells[i][c];
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace relight::tables
