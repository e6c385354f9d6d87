#include <algorithm>

#include <fmt/format.h>

#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight::report {

namespace {

using Stages = std::vector<std::pair<std::string, double>>;

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return escaped(name);
}

// Horizontal bars on one linear scale; the longest stage of the chart fills the width.
std::string bars(const std::string& title, const Stages& stages, const char* css_class) {
  if (stages.empty()) return "";
  constexpr int row = 22, label = 170, length = 260;
  double longest = 0.0, total = 0.0;
  for (const auto& [name, seconds] : stages) longest = std::max(longest, seconds), total += seconds;
  std::string shapes;
  int y = 4;
  for (const auto& [name, seconds] : stages) {
    const double width = longest > 0.0 ? length * seconds / longest : 0.0;
    shapes += fmt::format(
        "<text x='{}' y='{}' text-anchor='end'>{}</text><rect class='{}' x='{}' y='{}' width='{:.1f}' "
        "height='14'/>"
        "<text x='{:.1f}' y='{}'>{}</text>",
        label - 8, y + 12, words(name), css_class, label, y + 1, std::max(width, 1.0), label + width + 6,
        y + 12, seconds_text(seconds));
    y += row;
  }
  return fmt::format("<div class=chart><h4>{}: {}</h4><svg viewBox='0 0 520 {}' role=img>{}</svg></div>",
                     title, seconds_text(total), y + 4, shapes);
}

std::string amounts(const RunRecord& r) {
  std::string html = "<table class=small><tbody>";
  for (const auto& [name, bytes] : r.memory_bytes) {
    html += fmt::format("<tr><td>{}</td><td class=num>{}</td></tr>", words(name), bytes_text(bytes));
  }
  for (const auto& [name, count] : r.counters) {
    html += fmt::format("<tr><td>{}</td><td class=num>{}</td></tr>", words(name), count_text(count));
  }
  return html + "</tbody></table>";
}

}  // namespace

std::string times_section(const Records& records) {
  std::string html = "<section><h2>Time and memory</h2>";
  html +=
      "<div class=charts>" + bars("Loading scene and view", records.front().setup_stages, "setup") + "</div>";
  for (const RunRecord& r : records) {
    html += fmt::format(
        "<h3>{}</h3><div class=charts>{}{}<div class=chart><h4>Bytes and counters</h4>{}</div></div>",
        escaped(r.method), bars("Precompute stages", r.precompute_stages, "precompute"),
        bars("Relight stages", r.relight_stages, "relight"), amounts(r));
  }
  return html +
         "<p class=note>Wall time on the steady clock. Relight stages are those of the run with the median "
         "time, after one relight to warm up.</p></section>";
}

}  // namespace relight::report
