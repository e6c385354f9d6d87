#include <cmath>

#include <fmt/format.h>

#include "experiments/experiment_page/page_parts.h"
#include "experiments/report/html.h"

namespace relight::page {

using report::escaped;
using tables::TableCell;
using tables::TableColumn;

namespace {

std::string cell_html(const TableCell& cell, bool number) {
  const std::string value = std::isfinite(cell.value) ? fmt::format(" data-v={}", cell.value) : "";
  const std::string classes = (number ? "num " : "") + cell.style;
  const std::string text = cell.link.empty()
                               ? escaped(cell.text)
                               : fmt::format("<a href='{}'>{}</a>", escaped(cell.link), escaped(cell.text));
  return fmt::format("<td{}{}>{}</td>", classes.empty() ? "" : " class='" + classes + "'", value, text);
}

}  // namespace

std::string html(const Table& table) {
  std::string out = fmt::format(
      "<div class=tablebox><table class=sortable id='t-{}'><caption>{} <a class=csv "
      "download='{}.csv'>CSV</a></caption><thead><tr>",
      table.name, escaped(table.title), table.name);
  for (const TableColumn& c : table.columns)
    out += fmt::format("<th{} tabindex=0>{}</th>", c.number ? " class=num" : "", escaped(c.title));
  out += "</tr></thead><tbody>";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (size_t i = 0; i < row.size(); ++i) out += cell_html(row[i], table.columns[i].number);
    out += "</tr>\n";
  }
  out += "</tbody></table>";
  if (!table.note.empty()) out += fmt::format("<p class=note>{}</p>", escaped(table.note));
  return out + "</div>";
}

}  // namespace relight::page
