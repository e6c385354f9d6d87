// The outcomes as CSV, JSON, Markdown and plain text.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiments/hard_cases/run_hard_cases.h"
#include "experiments/options/csv_cell.h"
#include "experiments/options/text_table.h"

namespace relight {

namespace {

using hard::Figure;
using Json = nlohmann::ordered_json;

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return out;
}

// JSON has no NaN or infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)); }

const char* verdict(const Figure& figure) { return figure.holds() ? "holds" : "broken"; }

// How much of its bound a figure uses up: 1 at the bound, more beyond it. Bounds of zero have no scale.
double used(const Figure& f) {
  if (!f.holds()) return INFINITY;
  if (f.bound == 0.0) return 0.0;
  const double ratio = f.side == hard::Side::at_most ? f.measured / f.bound : f.bound / f.measured;
  return f.bound > 0.0 ? ratio : 1.0 / ratio;
}

std::string figure_text(const Figure& f) {
  return fmt::format("{}: {} ({})", f.what, number_text(f.measured), bound_text(f));
}

// The figure that is closest to breaking, or broken.
const Figure& tightest(const hard::Figures& figures) {
  return *std::max_element(figures.begin(), figures.end(),
                           [](const Figure& a, const Figure& b) { return used(a) < used(b); });
}

}  // namespace

std::string number_text(double value) { return fmt::format("{:.4g}", value); }

std::string bound_text(const Figure& figure) {
  return fmt::format("{} {}", figure.side == hard::Side::at_most ? "<=" : ">=", number_text(figure.bound));
}

std::string verdict_text(const HardCaseOutcome& outcome) {
  if (outcome.holds()) return "holds";
  return outcome.failure.empty() ? "broken" : "broken: " + outcome.failure;
}

std::string hard_cases_csv(const std::vector<HardCaseOutcome>& outcomes) {
  std::string text = "owner,case,breaks,figure,measured,side,bound,why,verdict,case_seconds\n";
  for (const HardCaseOutcome& o : outcomes) {
    const std::string head = fmt::format("{},{},{}", csv_cell(o.owner), csv_cell(o.name), csv_cell(o.breaks));
    for (const Figure& f : o.figures)
      text += fmt::format("{},{},{:.9g},{},{:.9g},{},{},{:.3f}\n", head, csv_cell(f.what), f.measured,
                          f.side == hard::Side::at_most ? "at_most" : "at_least", f.bound, csv_cell(f.why),
                          verdict(f), o.seconds);
    if (!o.failure.empty())
      text += fmt::format("{},{},,,,,{},{:.3f}\n", head, csv_cell(o.failure), "broken", o.seconds);
  }
  return text;
}

std::string hard_cases_json(const std::vector<HardCaseOutcome>& outcomes, const Provenance& p) {
  Json json = {{"broken", broken(outcomes)}, {"cases", Json::array()}};
  for (const HardCaseOutcome& o : outcomes) {
    Json entry = {{"owner", o.owner},           {"case", o.name},       {"breaks", o.breaks},
                  {"verdict", verdict_text(o)}, {"seconds", o.seconds}, {"figures", Json::array()}};
    for (const Figure& f : o.figures)
      entry["figures"].push_back({{"figure", f.what},
                                  {"measured", number(f.measured)},
                                  {"side", f.side == hard::Side::at_most ? "at_most" : "at_least"},
                                  {"bound", number(f.bound)},
                                  {"why", f.why},
                                  {"verdict", verdict(f)}});
    json["cases"].push_back(std::move(entry));
  }
  json["provenance"] = {
      {"commit", p.commit}, {"dirty", p.dirty},     {"compiler", p.compiler}, {"build_type", p.build_type},
      {"cpu", p.cpu},       {"threads", p.threads}, {"date", p.date}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string hard_cases_markdown(const std::vector<HardCaseOutcome>& outcomes, const Provenance& p) {
  std::string text = fmt::format(
      "# Hard cases\n\n{} cases, {} broken. Commit {}{}, {}, {}, {}.\n\n| case | what could break | "
      "measured | bound | why | verdict |\n|---|---|---|---|---|---|\n",
      outcomes.size(), broken(outcomes), p.commit.substr(0, 12), p.dirty ? " (changed)" : "", p.compiler,
      p.cpu, p.date);
  for (const HardCaseOutcome& o : outcomes) {
    const std::string name = markdown_cell(fmt::format("**{}**: {}", o.owner, o.name));
    bool first = true;
    for (const Figure& f : o.figures) {
      text +=
          fmt::format("| {} | {} | {}: {} | {} | {} | {} |\n", first ? name : "",
                      first ? markdown_cell(o.breaks) : "", markdown_cell(f.what), number_text(f.measured),
                      bound_text(f), markdown_cell(f.why), f.holds() ? "holds" : "**broken**");
      first = false;
    }
    if (!o.failure.empty())
      text += fmt::format("| {} | {} | | | {} | **broken** |\n", name, markdown_cell(o.breaks),
                          markdown_cell(o.failure));
  }
  return text;
}

std::string hard_cases_text(const std::vector<HardCaseOutcome>& outcomes) {
  TextTable table({"case", "closest to its bound", "verdict", "s"});
  for (const HardCaseOutcome& o : outcomes) {
    const std::string figure = o.figures.empty() ? "" : figure_text(tightest(o.figures));
    table.add_row(
        {o.owner + ": " + o.name, figure, o.holds() ? "holds" : "BROKEN", fmt::format("{:.1f}", o.seconds)});
  }
  std::string text = table.to_string(3);
  for (const HardCaseOutcome& o : outcomes) {
    if (o.holds()) continue;
    text += fmt::format("\nBROKEN {}: {}\n  what could break: {}\n", o.owner, o.name, o.breaks);
    for (const Figure& f : o.figures)
      text += fmt::format("  {:7}{}; {}\n", verdict(f), figure_text(f), f.why);
    if (!o.failure.empty()) text += "  " + o.failure + "\n";
  }
  return text + fmt::format("\n{} cases, {} broken\n", outcomes.size(), broken(outcomes));
}

}  // namespace relight
