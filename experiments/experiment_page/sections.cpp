// Who wins, what was left out, and where the numbers come from.
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/experiment_page/page_parts.h"
#include "experiments/report/html.h"
#include "experiments/tables/winners.h"

namespace relight::page {

using report::escaped;
using tables::Group;
using tables::TableCell;
using tables::text_cell;

namespace {

TableCell percent(const std::optional<LossInterval>& loss) {
  if (!loss) return text_cell("-");
  return {fmt::format("{:.3g} % ({:.3g} … {:.3g})", 100 * loss->value, 100 * loss->low, 100 * loss->high),
          100 * loss->value, "", ""};
}

void add_decisions(Table& table, const Group& group, const tables::Point& p, const EffectPlan& plan) {
  for (const EffectDecision& d : plan.effects) {
    const bool user_set = d.settings.empty();
    table.rows.push_back(
        {text_cell(group.title()), text_cell(p.name()), text_cell(d.effect),
         text_cell(fmt::format("{} of {}", d.level, d.everything)), text_cell(to_string(d.by)),
         percent(user_set ? std::nullopt : std::optional(d.loss)), percent(d.measured), text_cell(d.reason)});
  }
  const auto& check = plan.check;
  table.rows.push_back(
      {text_cell(group.title()), text_cell(p.name()), text_cell("whole plan"),
       text_cell(fmt::format("tolerance {:.3g} %", 100 * plan.tolerance)), text_cell(""), percent(plan.loss),
       percent(check ? std::optional(check->measured) : std::nullopt),
       text_cell(check ? fmt::format("{}, {}", to_string(check->verdict),
                                     check->as_predicted ? "as predicted" : "not as predicted")
                       : "not checked")});
}

Table effects_table(const Results& results) {
  Table table{"effects", "Effect plans", {}, {}, ""};
  table.columns = {{"where", false},          {"run", false},        {"effect", false},
                   {"level", false},          {"decided by", false}, {"loses, predicted", true},
                   {"loses, measured", true}, {"why", false}};
  for (const Group& group : results.groups)
    for (const tables::Point& p : group.points)
      if (const auto& plan = results.records[p.record].effect_plan) add_decisions(table, group, p, *plan);
  table.note =
      "Shares of the picture with 95 % intervals. The errors on this page are against the reference of the "
      "planned light paths: these losses come on top.";
  return table;
}

// Method -> what it leaves out -> on which scenes.
Table not_simulated_table(const Results& results) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> scenes;
  for (const RunRecord& r : results.records)
    for (const std::string& sentence : r.not_simulated) scenes[{r.method, sentence}].insert(r.scene);
  Table table{"not_simulated", "Light that the methods leave out", {}, {}, ""};
  table.columns = {{"method", false}, {"not simulated", false}, {"on", false}};
  for (const auto& [what, where] : scenes)
    table.rows.push_back({text_cell(what.first), text_cell(what.second),
                          text_cell(fmt::format("{}", fmt::join(where, ", ")))});
  table.note =
      "Each run is compared with the reference restricted to the light paths that the method carries: what "
      "it leaves out is not part of its error.";
  return table;
}

std::string machine(const Provenance& p) {
  return fmt::format("{}, {} threads; OpenGL: {}, {}", p.cpu, p.threads, p.gl_renderer, p.gl_version);
}

}  // namespace

std::string who_wins_section(const Results& results) {
  std::string html = "<section id=winners><h2>Who wins</h2><ul>";
  for (const std::string& sentence : tables::who_wins(results.groups))
    html += fmt::format("<li>{}</li>", escaped(sentence));
  return html +
         "</ul><p class=note>By the relative error; each method by its best run within the time. A method is "
         "named alone only where intervals do not overlap; they hold the noise of the reference, not that of "
         "the method's own random numbers.</p></section>";
}

std::string left_out_section(const Results& results, const std::vector<std::string>& scenes) {
  std::string out = "<section id=left-out><h2>What was not simulated, and why</h2>";
  const Table plans = effects_table(results), left_out = not_simulated_table(results);
  if (!left_out.rows.empty()) out += html(left_out);
  if (!plans.rows.empty()) out += html(plans);
  if (plans.rows.empty()) out += "<p>No effects were planned: the knobs decided what is simulated.</p>";
  for (const std::string& sentence : scenes) out += fmt::format("<p>Left out: {}</p>", escaped(sentence));
  return out + "</section>";
}

std::string provenance_section(const Results& results, const std::vector<std::string>& warnings) {
  std::map<std::string, size_t> commits, machines, compilers, references;
  std::string first, last;
  for (const RunRecord& r : results.records) {
    const Provenance& p = r.provenance;
    if (p.date.empty()) continue;  // it failed before it began
    ++commits[p.commit + (p.dirty ? " with local changes" : "")];
    ++machines[machine(p)];
    ++compilers[p.compiler + ", " + p.build_type];
    if (r.reference)
      ++references[fmt::format("{} paths a pixel, {}", r.reference->samples, r.reference->estimator)];
    if (first.empty() || p.date < first) first = p.date;
    if (p.date > last) last = p.date;
  }
  std::string html = "<section id=provenance><h2>Where the numbers come from</h2><table class=small><tbody>";
  const auto rows = [&](const char* what, const auto& all) {
    for (const auto& [value, count] : all)
      html += fmt::format("<tr><td>{}</td><td>{}{}</td></tr>", what, escaped(value),
                          all.size() > 1 ? fmt::format(" ({} runs)", count) : "");
  };
  rows("commit", commits), rows("machine", machines), rows("compiler", compilers),
      rows("reference", references);
  html +=
      fmt::format("<tr><td>date</td><td>{} to {}</td></tr></tbody></table>", escaped(first), escaped(last));
  if (machines.size() > 1)
    html +=
        "<p class=warning>Runs of several machines stand on this page: their times must not be compared.</p>";
  std::map<std::string, size_t> all;
  for (const RunRecord& r : results.records)
    for (const std::string& w : r.warnings) ++all[r.method + ", " + r.scene + ": " + w];
  for (const std::string& w : warnings) ++all[w];
  if (all.empty()) return html + "</section>";
  html += fmt::format("<details><summary>{} warnings</summary><ul class=warn>", all.size());
  for (const auto& [w, count] : all)
    html += fmt::format("<li>{}{}</li>", escaped(w), count > 1 ? fmt::format(" ({} runs)", count) : "");
  return html + "</ul></details></section>";
}

}  // namespace relight::page
