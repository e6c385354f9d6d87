// Accuracy against what it cost: the plots' data, and the tables that stand beside each plot.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiments/experiment_page/page_parts.h"
#include "experiments/report/html.h"
#include "experiments/tables/fronts.h"

namespace relight::page {

using namespace tables;
using nlohmann::json;
using report::escaped;

namespace {

// JSON has no NaN: null.
json interval(const Measured& m) {
  if (!m.known()) return nullptr;
  return {m.value, m.low, m.high};
}

std::vector<std::string> all_methods(const Results& results) {
  std::vector<std::string> names;
  for (const Group& g : results.groups)
    for (const std::string& name : g.methods())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

json fronts(const Group& group, ErrorKind error, CostKind cost) {
  json by_method = json::object();
  for (const std::string& method : group.methods())
    by_method[method] = pareto_front(group.points, error, cost, method);
  return {{"all", pareto_front(group.points, error, cost)}, {"methods", by_method}};
}

json group_json(const Results& results, const Group& group) {
  json points = json::array(), floors = json::object(), all_fronts = json::object();
  for (const Point& p : group.points) {
    json errors = json::object(), costs = json::object();
    for (const ErrorKind e : all_errors) errors[key(e)] = interval(p[e]);
    for (const CostKind c : all_costs) costs[key(c)] = interval(p[c]);
    points.push_back({{"method", p.method},
                      {"label", p.label},
                      {"errors", errors},
                      {"costs", costs},
                      {"failed", p.failure},
                      {"link", p.record < results.links.size() ? results.links[p.record] : ""}});
  }
  for (const ErrorKind e : all_errors) {
    floors[key(e)] = interval(group.noise_floors[static_cast<size_t>(e)]);
    for (const CostKind c : all_costs) all_fronts[fmt::format("{} {}", key(e), key(c))] = fronts(group, e, c);
  }
  return {{"title", group.title()}, {"points", points}, {"floors", floors}, {"fronts", all_fronts}};
}

std::string options(bool errors) {
  std::string html;
  const auto add = [&](auto choice) {
    html += fmt::format("<option value={}>{}</option>", key(choice), title(choice));
  };
  if (errors)
    for (const ErrorKind e : all_errors) add(e);
  else
    for (const CostKind c : all_costs) add(c);
  return html;
}

std::string shown_only(ErrorKind e, CostKind c, const Table& table) {
  if (table.rows.empty()) return "";
  const bool first = e == ErrorKind::relative && c == CostKind::relight;
  return fmt::format("<div class=choice data-error={} data-cost={}{}>{}</div>", key(e), key(c),
                     first ? "" : " hidden", html(table));
}

std::string group_html(const Results& results, const Group& group, size_t number) {
  size_t failed = 0;
  for (const Point& p : group.points) failed += p.failure.empty() ? 0 : 1;
  std::string out = fmt::format(
      "<div class=group><h3>{}</h3><p class=note>Light paths: {}. {} runs{}.</p><div class=beside>"
      "<div class=plot data-group={}></div><div class=limits>",
      escaped(group.title()), escaped(group.paths.empty() ? "not known" : group.paths), group.points.size(),
      failed == 0 ? "" : fmt::format(", <b class=failedtext>{} of them failed and are not drawn</b>", failed),
      number);
  for (const ErrorKind e : all_errors)
    for (const CostKind c : all_costs) {
      out += shown_only(e, c, equal_cost_table(results, group, e, c));
      out += shown_only(e, c, equal_error_table(results, group, e, c));
    }
  return out + "</div></div></div>\n";
}

}  // namespace

std::string plot_data(const Results& results) {
  json groups = json::array();
  for (const Group& g : results.groups) groups.push_back(group_json(results, g));
  std::string text = json{{"methods", all_methods(results)}, {"groups", groups}}.dump(
      -1, ' ', false, json::error_handler_t::replace);
  // Inside a script element only "</" could end it early.
  for (size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.insert(at + 1, "\\");
  return text;
}

std::string accuracy_section(const Results& results) {
  std::string html = fmt::format(
      "<section id=accuracy><h2>Accuracy against time, memory and precompute</h2><div id=controls>"
      "<label>error <select id=error-choice>{}</select></label> <label>cost <select "
      "id=cost-choice>{}</select>"
      "</label> <span id=legend></span></div>",
      options(true), options(false));
  html +=
      "<p class=note>Both axes are logarithmic. A step line is the front of one method: the smallest error "
      "that one of "
      "its runs reaches within the cost; runs on it are full, others faded; a dark ring marks what no run of "
      "any method "
      "beats. Bars: 95&#8239;% interval of the error due to the reference's noise; smallest and largest "
      "repeat of the "
      "relight time. Dashed: the error that a perfect method would show because of that noise. Click a point "
      "for its "
      "pictures, a method's name to hide it.</p><p class=note>In the tables each method is shown by one of "
      "its own runs, nothing is interpolated. A winner is named only if its interval overlaps with that of "
      "no other method. An error is reached if the upper end of its interval is, a time if the median is. "
      "Limits at which nothing changes are left out.</p>";
  for (size_t i = 0; i < results.groups.size(); ++i) html += group_html(results, results.groups[i], i);
  return html + "</section>";
}

}  // namespace relight::page
