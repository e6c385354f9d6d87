#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiments/tables/table.h"

namespace relight::tables {
namespace {

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return out;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string latex_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      out += fmt::format("\\{}{{}}", c);
    else if (c == '<' || c == '>' || c == '|')
      out += fmt::format("${}$", c);
    else
      out += std::string("&%$#_{}").find(c) != std::string::npos ? fmt::format("\\{}", c) : std::string(1, c);
  }
  replace_all(out, "±", "$\\pm$");
  replace_all(out, "≤", "$\\le$");
  replace_all(out, "…", "\\dots{}");
  return out;
}

}  // namespace

std::string markdown(const Table& table) {
  std::string head = "|", line = "|";
  for (const TableColumn& c : table.columns)
    head += fmt::format(" {} |", markdown_cell(c.title)), line += c.number ? "---:|" : "---|";
  std::string out = fmt::format("## {}\n\n{}\n{}\n", table.title, head, line);
  for (const auto& row : table.rows) {
    out += "|";
    for (const TableCell& cell : row)
      out += cell.style == "best" ? fmt::format(" **{}** |", markdown_cell(cell.text))
                                  : fmt::format(" {} |", markdown_cell(cell.text));
    out += "\n";
  }
  return out + (table.note.empty() ? "" : "\n" + table.note + "\n");
}

std::string latex(const Table& table) {
  std::string columns;
  std::vector<std::string> head;
  for (const TableColumn& c : table.columns)
    columns += c.number ? 'r' : 'l', head.push_back(latex_cell(c.title));
  std::string out = fmt::format(
      "\\begin{{table}}\n\\caption{{{}}}\n\\label{{tab:{}}}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{} "
      "\\\\\n\\midrule\n",
      latex_cell(table.title), table.name, columns, fmt::join(head, " & "));
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const TableCell& cell : row)
      cells.push_back(cell.style == "best" ? fmt::format("\\textbf{{{}}}", latex_cell(cell.text))
                                           : latex_cell(cell.text));
    out += fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  }
  return out + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

std::string json_text(const Table& table) {
  using Json = nlohmann::ordered_json;
  Json columns = Json::array(), rows = Json::array();
  for (const TableColumn& c : table.columns) columns.push_back(c.title);
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (size_t i = 0; i < row.size(); ++i) {
      const bool number = table.columns[i].number && std::isfinite(row[i].value);
      cells.push_back(number ? Json(row[i].value) : Json(row[i].text));
    }
    rows.push_back(std::move(cells));
  }
  const Json out = {{"name", table.name}, {"title", table.title}, {"columns", columns}, {"rows", rows}};
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace relight::tables
