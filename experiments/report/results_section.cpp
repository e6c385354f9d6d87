#include <fmt/format.h>

#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

std::string error_cell(const std::optional<ErrorReport>& errors, double MetricSet::*metric, bool best) {
  if (!errors) return "<td class=num>&ndash;</td>";
  return fmt::format("<td class='num{}'><b>{}</b><small>floor {} &plusmn; {}</small></td>",
                     best ? " best" : "", percent_text(errors->value.*metric),
                     percent_text(errors->noise_floor.*metric), percent_text(errors->half_width.*metric));
}

std::string plain_cell(const std::optional<ErrorReport>& errors, double MetricSet::*metric) {
  return errors ? fmt::format("<td class=num>{:.3g}</td>", errors->value.*metric)
                : "<td class=num>&ndash;</td>";
}

std::string cost_cells(const RunRecord& r) {
  if (r.relight_ms.repeats == 0)
    return "<td class=num>&ndash;</td><td class=num>&ndash;</td><td class=num>&ndash;</td>";
  return fmt::format(
      "<td class=num>{}</td><td class=num>{}<small>{} &hellip; {}, {} runs</small></td><td class=num>{}</td>",
      seconds_text(r.precompute_s), seconds_text(1e-3 * r.relight_ms.median),
      seconds_text(1e-3 * r.relight_ms.min), seconds_text(1e-3 * r.relight_ms.max), r.relight_ms.repeats,
      bytes_text(prepared_bytes(r)));
}

bool smallest(const Records& records, const RunRecord& record) {
  if (records.size() < 2 || !record.errors || !record.failed_stages.empty()) return false;
  for (const RunRecord& other : records) {
    if (other.errors && other.errors->value.relative < record.errors->value.relative) return false;
  }
  return true;
}

}  // namespace

std::string results_section(const Records& records) {
  std::string html =
      "<section><h2>Results</h2><table><thead><tr><th>Method</th><th class=num>Relative error</th><th "
      "class=num>Edges "
      "left out</th><th class=num>Indirect<br>light only</th><th class=num>Un-<br>clamped</th><th "
      "class=num>RMSE</th>"
      "<th class=num>relMSE</th><th class=num>Bias</th><th class=num>SSIM</th><th class=num>Largest</th>"
      "<th class=num>Pre-<br>compute</th><th class=num>Relight</th><th "
      "class=num>Memory</th></tr></thead><tbody>";
  for (const RunRecord& r : records) {
    html +=
        fmt::format("<tr{}><th>{}</th>", r.failed_stages.empty() ? "" : " class=failed", escaped(r.method));
    html += error_cell(r.errors, &MetricSet::relative, smallest(records, r));
    html += error_cell(r.errors, &MetricSet::relative_edges_out, false);
    html += error_cell(r.errors_indirect, &MetricSet::relative, false);
    html += r.errors ? fmt::format("<td class=num>{}</td>", percent_text(r.errors->value.relative_hdr))
                     : "<td class=num>&ndash;</td>";
    html += plain_cell(r.errors, &MetricSet::rmse) + plain_cell(r.errors, &MetricSet::relmse);
    html += r.errors ? fmt::format("<td class=num>{}</td>", percent_text(r.errors->value.bias))
                     : "<td class=num>&ndash;</td>";
    html += plain_cell(r.errors, &MetricSet::ssim) + plain_cell(r.errors, &MetricSet::max);
    html += cost_cells(r) + "</tr>";
    for (const std::string& failure : r.failed_stages) {
      html += fmt::format("<tr class=failed><td colspan=13>Failed: {}</td></tr>", escaped(failure));
    }
  }
  html +=
      "</tbody></table><p class=note>Relative error = |A&minus;R|<sub>2</sub> / |R|<sub>2</sub> with "
      "approximation A "
      "and reference R clamped to [0,1] after the scene's fixed exposure; <i>unclamped</i> is the same "
      "without "
      "exposure and clamp. RMSE = &radic;mean (A&minus;R)&sup2;, relMSE = mean "
      "(A&minus;R)&sup2;/(R&sup2;+0.01), bias "
      "= mean(A&minus;R)/mean(R). The <i>floor</i> is the value that a perfect method would show because of "
      "the "
      "reference's own noise; &plusmn; is half of the 95&#8239;% confidence interval.";
  for (const RunRecord& r : records) {
    if (!r.errors) continue;
    html += fmt::format(" Edge pixels left out: {} of the picture.", percent_text(r.errors->edge_share));
    break;
  }
  return html + "</p></section>";
}

std::string paths_section(const Records& records) {
  std::string html =
      "<section><h2>What was compared</h2><table><thead><tr><th>Method</th><th>Light paths it carries"
      "</th><th>Light paths of its reference</th><th>Not simulated</th></tr></thead><tbody>";
  for (const RunRecord& r : records) {
    html += fmt::format("<tr><th>{}</th><td>{}</td><td{}>{}</td><td><ul>", escaped(r.method),
                        escaped(r.light_paths), r.light_paths == r.reference_paths ? "" : " class=warn",
                        escaped(r.reference_paths));
    for (const std::string& sentence : r.not_simulated) html += fmt::format("<li>{}</li>", escaped(sentence));
    html += "</ul></td></tr>";
  }
  return html +
         "</tbody></table><p class=note>Heckbert's notation: E eye, D diffuse, G glossy, L light. Direct "
         "light "
         "is always compared.</p></section>";
}

}  // namespace relight::report
