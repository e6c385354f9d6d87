// What the errors consist of: the waterfalls of `relight explain-error` that lie in the folders of the runs.
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiments/experiment_page/page_parts.h"

namespace relight::page {
namespace {

using Json = nlohmann::json;
using tables::TableCell;
using tables::text_cell;

// Nothing where the file has null.
TableCell number(const Json& json, double factor, int digits) {
  if (!json.is_number()) return text_cell("");
  const double value = factor * json.get<double>();
  return {fmt::format("{:.{}f}", value, digits), value, "", ""};
}

TableCell percent(const Json& measures) { return number(measures.at("relative"), 100.0, 2); }

class Rows {
 public:
  Rows(Table& table, std::string where, const tables::Point& run, std::string link)
      : table_(table), where_(std::move(where)), run_(run.name()), link_(std::move(link)) {}

  void add_all(const Json& json) {
    add("as asked", {percent(json.at("asked")), percent(json.at("asked_half_width")), text_cell(""),
                     text_cell(""), text_cell("")});
    for (const Json& stage : json.at("stages")) {
      if (!stage.at("active").get<bool>()) continue;
      add(stage.at("stage"),
          {percent(stage.at("points")), percent(stage.at("half_width")), percent(stage.at("alone_points")),
           number(stage.at("precompute_saved_s"), 1.0, 2), number(stage.at("relight_saved_ms"), 1.0, 1)});
    }
    const Json& rest = json.at("remainder");
    add("left: " + rest.at("stage").get<std::string>(),
        {percent(rest.at("points")), percent(rest.at("half_width")), text_cell(""), text_cell(""),
         text_cell("")});
    const Json& model = json.at("model");
    add("(not simulated)", {percent(model.at("share")), percent(model.at("half_width")), text_cell(""),
                            text_cell(""), text_cell("")});
  }

 private:
  void add(const std::string& stage, const std::vector<TableCell>& cells) {
    std::vector<TableCell> row = {text_cell(where_), {run_, TableCell{}.value, "", link_}, text_cell(stage)};
    row.insert(row.end(), cells.begin(), cells.end());
    table_.rows.push_back(std::move(row));
  }
  Table& table_;
  std::string where_, run_, link_;
};

}  // namespace

Table explained_table(const Results& results, const std::vector<RunFolder>& folders,
                      std::vector<std::string>& warnings) {
  Table table{"explained", "What the errors consist of, in points of relative error", {}, {}, ""};
  table.columns = {{"where", false},
                   {"run", false},
                   {"stage", false},
                   {"points", true},
                   {"+-", true},
                   {"alone", true},
                   {"saves precompute s", true},
                   {"saves relight ms", true}};
  for (const tables::Group& group : results.groups)
    for (const tables::Point& p : group.points) {
      const std::filesystem::path file = folders[p.record].path / "waterfall.json";
      std::ifstream in(file);
      if (folders[p.record].path.empty() || !in) continue;
      Table rows;
      try {
        Rows(rows, group.title(), p, folders[p.record].link).add_all(Json::parse(in));
      } catch (const Json::exception& error) {
        warnings.push_back(fmt::format("{}: not a waterfall of explain-error of this version: {}",
                                       file.string(), error.what()));
        continue;
      }
      table.rows.insert(table.rows.end(), rows.rows.begin(), rows.rows.end());
    }
  table.note =
      "On some pixels spread over the view (relight explain-error): the points of the stages and of what is "
      "left "
      "add up to the error as asked. Alone: the stage with all others exact. Saves: against its exact twin, "
      "on these pixels only. "
      "Not simulated: light that the method does not carry, of the picture of every light path; no part of "
      "the error.";
  return table;
}

std::string explained_section(const Table& explained) {
  if (explained.rows.empty()) return "";
  return "<section id=explained><h2>What the errors consist of</h2>" + html(explained) + "</section>\n";
}

}  // namespace relight::page
