#include <fmt/format.h>

#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

std::string interval_cell(const std::optional<LossInterval>& loss) {
  if (!loss) return "<td class=num>&ndash;</td>";
  return fmt::format("<td class=num>{}<small>{} &hellip; {}</small></td>", percent_text(loss->value),
                     percent_text(loss->low), percent_text(loss->high));
}

std::string decisions(const EffectPlan& plan) {
  std::string html =
      "<table><thead><tr><th>Effect</th><th>Level</th><th>Decided by</th><th class=num>Loses, predicted</th>"
      "<th class=num>Loses, measured</th><th>Why</th></tr></thead><tbody>";
  for (const EffectDecision& d : plan.effects) {
    const bool user_set = d.settings.empty();
    html += fmt::format("<tr{}><th>{}<small>{}</small></th><td>{} of {}</td><td>{}</td>{}{}<td>{}</td></tr>",
                        d.undecided ? " class=warn" : "", escaped(d.effect), escaped(d.sentence),
                        escaped(d.level), escaped(d.everything), to_string(d.by),
                        interval_cell(user_set ? std::nullopt : std::optional(d.loss)),
                        interval_cell(d.measured), escaped(d.reason));
  }
  return html + "</tbody></table>";
}

std::string whole_plan(const EffectPlan& plan) {
  std::string html = fmt::format(
      "<p>Tolerance {}; the whole plan was predicted to lose {} ({} &hellip; {}) of everything: {}.",
      percent_text(plan.tolerance), percent_text(plan.loss.value), percent_text(plan.loss.low),
      percent_text(plan.loss.high), escaped(plan.everything));
  if (const auto& check = plan.check)
    html += fmt::format(
        " Measured afterwards with {} paths a pixel: {} ({} &hellip; {}): the tolerance is "
        "<b>{}</b>, {}.",
        count_text(check->samples), percent_text(check->measured.value), percent_text(check->measured.low),
        percent_text(check->measured.high), to_string(check->verdict),
        check->as_predicted ? "as predicted" : "not as predicted");
  if (plan.beyond)
    html += fmt::format(" More bounces than everything has would be {} of the picture.",
                        percent_text(plan.beyond->value));
  for (const LightNote& l : plan.lights)
    html += fmt::format(" Light '{}': {}.", escaped(l.light), escaped(l.note));
  return html + "</p>";
}

std::string savings(const EverythingRun& all) {
  const auto row = [](const char* what, const std::string& planned, const std::string& everything) {
    return fmt::format("<tr><td>{}</td><td class=num>{}</td><td class=num>{}</td></tr>", what, planned,
                       everything);
  };
  return "<table class=small><thead><tr><th></th><th class=num>Planned</th><th class=num>Everything "
         "on</th></tr></thead><tbody>" +
         row("precompute", seconds_text(all.planned_precompute_s), seconds_text(all.precompute_s)) +
         row("relight", seconds_text(1e-3 * all.planned_relight_ms), seconds_text(1e-3 * all.relight_ms)) +
         row("memory", bytes_text(all.planned_bytes), bytes_text(all.bytes)) +
         fmt::format("</tbody></table><p>The two pictures of the method differ by {}.</p>",
                     percent_text(all.picture_change));
}

}  // namespace

std::string effects_section(const Records& records) {
  std::string html;
  for (const RunRecord& r : records) {
    if (!r.effect_plan) continue;
    const EffectPlan& plan = *r.effect_plan;
    html += fmt::format("<h3>{}</h3>{}{}", escaped(r.method), decisions(plan), whole_plan(plan));
    if (plan.check && plan.check->everything) html += savings(*plan.check->everything);
    html += fmt::format("<p class=note>Planned in {}.</p>", seconds_text(plan.seconds));
  }
  if (html.empty()) return "";
  return "<section><h2>What was not simulated and why</h2>" + html +
         "<p class=note>A loss is |clamp(R) &minus; clamp(R &minus; lost)|<sub>2</sub> / "
         "|clamp(R)|<sub>2</sub> "
         "with R the picture of everything that the method can do; 95&#8239;% interval beneath. "
         "The errors above are against the reference of the planned light paths: these losses come on "
         "top.</p></section>";
}

}  // namespace relight::report
