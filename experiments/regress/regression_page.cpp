// The regression as one self-contained page.
#include <fmt/format.h>

#include "experiments/regress/cells.h"
#include "experiments/regress/regress.h"
#include "experiments/report/html.h"

namespace relight {
namespace {

using report::escaped;

constexpr const char* style = R"css(
body { margin:0 auto; max-width:1400px; padding:28px 32px 64px; color:#1f2328; background:#fff;
  font:15px/1.45 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size:26px; margin:0 0 4px; } h2 { font-size:19px; margin:34px 0 10px; color:#0a5f8a; }
section { overflow-x:auto; } table { border-collapse:collapse; width:100%; font-size:13.5px; }
th, td { text-align:left; vertical-align:top; padding:6px 8px; border-bottom:1px solid #d8dee4; }
thead th { background:#f6f8fa; } td.num { font-variant-numeric:tabular-nums; white-space:nowrap; }
tr.changed td, tr.missing td { background:#ffebe9; } tr.new td { background:#ddf4ff; }
td ul { margin:4px 0 0; padding-left:18px; } li.note { color:#656d76; } .notes { background:#fff8c5; }
.good { color:#1a7f37; } .bad { color:#cf222e; } .notes { padding:10px 10px 10px 28px; border:1px solid #eac54f; }
pre { background:#f6f8fa; border:1px solid #d8dee4; padding:10px 12px; font-size:12.5px; white-space:pre-wrap; }
)css";

std::string row_class(Verdict verdict) {
  switch (verdict) {
    case Verdict::changed:
      return "changed";
    case Verdict::missing:
      return "missing";
    case Verdict::added:
      return "new";
    case Verdict::same:
      break;
  }
  return "same";
}

std::string words_of(const RunComparison& run) {
  if (run.verdict == Verdict::missing) return "published, but not among the fresh runs";
  std::string list;
  for (const Change& change : run.changes)
    list += fmt::format("<li{}>{}</li>", change.weight == Weight::note ? " class=note" : "",
                        escaped(change.words));
  return list.empty() ? "" : "<ul>" + list + "</ul>";
}

std::string section_of(const Regression& regression) {
  std::string html = fmt::format("<section><h2>{}: <span class={}>{}</span></h2>", escaped(regression.name),
                                 regression.good() ? "good" : "bad", regression.good() ? "same" : "changed");
  if (!regression.notes.empty()) {
    html += "<ul class=notes>";
    for (const std::string& note : regression.notes) html += fmt::format("<li>{}</li>", escaped(note));
    html += "</ul>";
  }
  html +=
      "<table><thead><tr><th>Run</th><th>Verdict</th><th>Relative error, %</th><th>Bias, %</th><th>Relight, "
      "ms</th><th>Precompute, s</th><th>What changed</th></tr></thead><tbody>";
  for (const RunComparison& run : regression.runs) {
    const RegressionCells cells = cells_of(run);
    html += fmt::format("<tr class={}><td>{}</td><td><b>{}</b></td>", row_class(run.verdict),
                        escaped(run.run), to_string(run.verdict));
    for (const std::string* cell : {&cells.relative, &cells.bias, &cells.relight, &cells.precompute})
      html += fmt::format("<td class=num>{}</td>", escaped(*cell));
    html += fmt::format("<td>{}</td></tr>", words_of(run));
  }
  return html + "</tbody></table></section>";
}

}  // namespace

std::string regression_page(const std::vector<Regression>& regressions, const std::string& pictures) {
  std::string html = fmt::format(
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>Regression</title><style>{}</style>"
      "</head><body><h1>Regression</h1><p>Published results against fresh ones. Cells read <i>published "
      "&rarr; fresh</i>. An error has changed if it moved by more than the 95&#8239;% intervals of both; "
      "counters and bytes are compared exactly; times by ratio, on the same machine only. Grey lines are "
      "notes.</p>",
      style);
  for (const Regression& regression : regressions) html += section_of(regression);
  html += "<section><h2>Stored reference pictures</h2>";
  html += pictures.empty() ? "<p>Not checked (<code>--references all</code>).</p>"
                           : fmt::format("<pre>{}</pre>", escaped(pictures));
  return html + "</section></body></html>\n";
}

}  // namespace relight
