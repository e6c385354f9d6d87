// The outcomes as one page that works from a file without a network.
#include <fmt/format.h>

#include "experiments/hard_cases/run_hard_cases.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight {

namespace {

using report::escaped;

constexpr const char* own_style =
    "td.verdict { font-weight:600; color:#1a7f37; } tr.failed td.verdict { color:#cf222e; } "
    "tr.first td, tr.first th { border-top:2px solid var(--line); } tbody th small { font-weight:400; }";

std::string figure_cells(const hard::Figure& f) {
  return fmt::format("<td>{}<td class=num>{}<td class=num>{}<td>{}<td class=verdict>{}", escaped(f.what),
                     escaped(number_text(f.measured)), escaped(bound_text(f)), escaped(f.why),
                     f.holds() ? "holds" : "broken");
}

// The case's name and what could break span the rows of its figures.
std::string rows_of(const HardCaseOutcome& o) {
  const size_t rows = o.figures.size() + (o.failure.empty() ? 0 : 1);
  std::string head = fmt::format("<th rowspan={}>{}<br><small>{:.1f} s</small><td rowspan={}>{}", rows,
                                 escaped(o.name), o.seconds, rows, escaped(o.breaks));
  std::string text;
  const auto add_row = [&](bool holds, const std::string& cells) {
    text += fmt::format("<tr class='{}{}'>{}{}\n", text.empty() ? "first" : "", holds ? "" : " failed", head,
                        cells);
    head.clear();
  };
  for (const hard::Figure& f : o.figures) add_row(f.holds(), figure_cells(f));
  if (!o.failure.empty())
    add_row(false, fmt::format("<td colspan=4>{}<td class=verdict>broken", escaped(o.failure)));
  return text;
}

}  // namespace

std::string hard_cases_html(const std::vector<HardCaseOutcome>& outcomes, const Provenance& p) {
  const int64_t bad = broken(outcomes);
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content='width=device-width'>"
      "<title>relight: hard cases</title><style>{}{}</style></head>\n<body><header><h1>Hard cases: {}</h1>"
      "<p>{} cases at which a method could divide by zero, lose its digits or its light. Each figure has a "
      "bound and "
      "a reason for it.</p></header>\n",
      report::style_sheet, own_style, bad == 0 ? "all bounds hold" : fmt::format("{} broken", bad),
      outcomes.size());
  for (size_t i = 0; i < outcomes.size(); ++i) {
    if (i == 0 || outcomes[i].owner != outcomes[i - 1].owner)
      page += fmt::format(
          "{}<section><h2>{}</h2><table><thead><tr><th>case<th>what could break<th>figure<th "
          "class=num>measured"
          "<th class=num>bound<th>why this bound<th>verdict</thead><tbody>\n",
          i == 0 ? "" : "</tbody></table></section>\n", escaped(outcomes[i].owner));
    page += rows_of(outcomes[i]);
  }
  return page + fmt::format(
                    "</tbody></table></section>\n<h2>Origin</h2><p class=note>Commit {}{}, {}, {}, {}, {} "
                    "threads, {}.</p></body></html>\n",
                    escaped(p.commit), p.dirty ? " (changed)" : "", escaped(p.compiler),
                    escaped(p.build_type), escaped(p.cpu), p.threads, escaped(p.date));
}

}  // namespace relight
