#include <fmt/format.h>

#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("<tr><td>{}</td><td>{}</td></tr>", escaped(name), value);
}

}  // namespace

std::string settings_section(const Records& records) {
  std::string html = "<section><h2>Settings</h2><div class=charts>";
  for (const RunRecord& r : records) {
    html += fmt::format("<div class=chart><h4>{}</h4><table class=small><tbody>", escaped(r.method));
    for (const auto& [knob, value] : r.knobs) html += row(knob, escaped(value));
    html += row("seed", std::to_string(r.seed));
    if (const auto& cost = r.reference) {
      html += row("reference", fmt::format("{} paths a pixel in {} batches, {}, {}",
                                           count_text(cost->samples), cost->batches, escaped(cost->estimator),
                                           cost->from_cache ? "from the cache"
                                                            : "traced in " + seconds_text(cost->seconds)));
    }
    html += "</tbody></table></div>";
  }
  html += "</div><h3>To run it again</h3>";
  for (const RunRecord& r : records) html += fmt::format("<pre>{}</pre>", escaped(r.command));
  return html + "</section>";
}

std::string origin_section(const Records& records, const std::vector<std::string>& unreadable) {
  const RunRecord& first = records.front();
  const Provenance& p = first.provenance;
  std::string html = "<section><h2>Where the numbers come from</h2><table class=small><tbody>";
  html += row("scene", fmt::format("{} ({} triangles, content {})", escaped(first.scene),
                                   count_text(first.triangles), escaped(first.scene_hash)));
  html += row("date", escaped(p.date));
  html += row("commit", escaped(p.commit) + (p.dirty ? " with local changes" : ""));
  html += row("compiler", escaped(p.compiler + ", " + p.build_type));
  html += row("processor", fmt::format("{}, {} threads", escaped(p.cpu), p.threads));
  html += row("OpenGL", escaped(p.gl_renderer + ", " + p.gl_version));
  html += "</tbody></table>";
  std::string warnings;
  for (const RunRecord& r : records) {
    for (const std::string& w : r.warnings)
      warnings += fmt::format("<li><b>{}</b>: {}</li>", escaped(r.method), escaped(w));
  }
  for (const std::string& w : unreadable) warnings += fmt::format("<li>{}</li>", escaped(w));
  if (!warnings.empty()) html += "<h3>Warnings</h3><ul class=warn>" + warnings + "</ul>";
  return html + "</section>";
}

}  // namespace relight::report
