#include "experiments/tables/paper_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/run/error.h"
#include "common/scene/files/toml_reader.h"

namespace relight::tables {
namespace {

// "13.6" or "13.1 to 15.5": both ends with half of the last printed digit.
double half_digit(const std::string& number) {
  const size_t point = number.find('.');
  const size_t decimals = point == std::string::npos ? 0 : number.size() - point - 1;
  return 0.5 * std::pow(10.0, -static_cast<double>(decimals));
}

double parse_number(const std::string& text, const TomlTable& table) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0')
    fail("{}: '{}': expected a number as printed, \"13.6\", or two, \"13.1 to 15.5\"", table.where("printed"),
         text);
  return value;
}

void read_printed(PaperFigure& figure, const TomlTable& table) {
  figure.printed = table.text("printed", "");
  const size_t to = figure.printed.find(" to ");
  const std::string first = figure.printed.substr(0, to);
  const std::string last = to == std::string::npos ? first : figure.printed.substr(to + 4);
  figure.low = parse_number(first, table) - half_digit(first);
  figure.high = parse_number(last, table) + half_digit(last);
}

void add_matches(PaperFigure& figure, const TomlTable& table) {
  const TomlTable match = table.table("match");
  for (const std::string& column : match.keys()) figure.match[column] = match.text(column, "");
}

// `figure`: what the group says of all its figures.
PaperFigure read_figure(PaperFigure figure, const TomlTable& table) {
  for (const char* key : {"what", "printed", "unit", "column", "better"}) table.require(key);
  figure.what = table.text("what", "");
  read_printed(figure, table);
  figure.unit = table.text("unit", ""), figure.column = table.text("column", "");
  figure.factor = table.number("factor", 1);
  figure.half_width = table.text("half_width", "");
  figure.better = table.text("better", "", {"smaller", "larger", "neither"});
  figure.of_machine = table.boolean("of_machine", false);
  add_matches(figure, table);
  table.refuse_unknown_keys();
  return figure;
}

void read_group(PaperNumbers& numbers, const TomlTable& table) {
  table.require("where"), table.require("figures");
  PaperFigure common;
  common.where = table.text("where", "");
  common.not_comparable = table.text("not_comparable", ""), common.remark = table.text("remark", "");
  add_matches(common, table);
  for (const TomlTable& figure : table.tables("figures"))
    numbers.figures.push_back(read_figure(common, figure));
  table.refuse_unknown_keys();
}

// A scene that is a file goes by the file's name.
bool matches(const CsvRow& run, const PaperFigure& figure) {
  for (const auto& [column, value] : figure.match) {
    const auto cell = run.find(column);
    if (cell == run.end()) return false;
    if (cell->second != value && std::filesystem::path(cell->second).stem() != value) return false;
  }
  const auto failed = run.find("failed");
  return failed == run.end() || failed->second.empty();
}

double number_in(const CsvRow& run, const std::string& column) {
  const auto cell = run.find(column);
  return cell == run.end() || cell->second.empty() ? std::nan("") : std::atof(cell->second.c_str());
}

// What tells the run, in the columns that stand before its errors.
std::string name_of(const CsvRow& run, const PaperFigure& figure) {
  std::string name;
  for (const char* column : {"scene", "lights", "method", "preset"})
    if (const auto cell = run.find(column); cell != run.end() && !cell->second.empty())
      name += (name.empty() ? "" : ", ") + std::filesystem::path(cell->second).stem().string();
  for (const auto& [column, value] : figure.match)
    if (column.find('.') != std::string::npos)
      name += ", " + column.substr(column.find('.') + 1) + "=" + value;
  return name;
}

}  // namespace

PaperNumbers read_paper_numbers(const std::filesystem::path& file) {
  const TomlTable table = TomlTable::parse_file(file);
  table.require("paper"), table.require("machine");
  PaperNumbers numbers{table.text("paper", ""), table.text("machine", ""), {}};
  for (const TomlTable& group : table.tables("groups")) read_group(numbers, group);
  table.refuse_unknown_keys();
  return numbers;
}

std::string verdict(const PaperFigure& figure, double ours, double half) {
  if (!figure.not_comparable.empty()) return "not comparable: " + figure.not_comparable;
  if (figure.of_machine) return "not comparable: other machine";
  if (ours - half <= figure.high && ours + half >= figure.low) return "within";
  const bool less = ours < figure.low;
  if (figure.better == "neither") return less ? "less" : "more";
  return less == (figure.better == "smaller") ? "better" : "worse";
}

Table paper_table(const PaperNumbers& numbers, const std::vector<CsvRow>& runs) {
  Table table{"paper", numbers.paper, {}, {}, "The paper's machine: " + numbers.machine + "."};
  table.columns = {{"figure", false}, {"where", false}, {"run", false},     {"paper", true},
                   {"ours", true},    {"unit", false},  {"verdict", false}, {"remark", false}};
  const auto text = [](const std::string& words) { return TableCell{words, TableCell{}.value, "", ""}; };
  for (const PaperFigure& figure : numbers.figures)
    for (const CsvRow& run : runs) {
      const double ours = figure.factor * number_in(run, figure.column);
      if (!matches(run, figure) || !std::isfinite(ours)) continue;
      const double half = figure.half_width.empty() ? 0.0 : figure.factor * number_in(run, figure.half_width);
      const std::string words = verdict(figure, ours, std::isfinite(half) ? half : 0.0);
      table.rows.push_back({text(figure.what),
                            text(figure.where),
                            text(name_of(run, figure)),
                            {figure.printed, 0.5 * (figure.low + figure.high), "", ""},
                            {fmt::format("{:.3g}", ours), ours, "", ""},
                            text(figure.unit),
                            text(words),
                            text(figure.remark)});
      table.rows.back()[6].style = words == "better" ? "best" : words == "worse" ? "failed" : "";
    }
  return table;
}

}  // namespace relight::tables
