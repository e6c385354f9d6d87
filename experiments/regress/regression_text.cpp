// The regression as text: a table, then what changed, run by run.
#include <cmath>

#include <fmt/format.h>

#include "experiments/options/text_table.h"
#include "experiments/regress/cells.h"
#include "experiments/regress/regress.h"

namespace relight {
namespace {

std::string count_line(const Regression& regression) {
  size_t counts[4] = {};
  for (const RunComparison& run : regression.runs) ++counts[static_cast<size_t>(run.verdict)];
  return fmt::format("{}: {} runs: {} the same, {} changed, {} missing, {} new\n", regression.name,
                     regression.runs.size(), counts[0], counts[1], counts[2], counts[3]);
}

std::string details(const RunComparison& run) {
  if (run.verdict == Verdict::missing)
    return fmt::format("{} {}\n  published, but not among the fresh runs\n", to_string(run.verdict), run.run);
  std::string text;
  for (const Change& change : run.changes)
    text += fmt::format("  {}{}\n", change.weight == Weight::note ? "(note) " : "", change.words);
  return text.empty() ? "" : fmt::format("{} {}\n{}", to_string(run.verdict), run.run, text);
}

}  // namespace

std::string regression_text(const Regression& regression) {
  TextTable table({"run", "verdict", "relative %", "bias %", "relight ms", "precompute s", "changed"});
  for (const RunComparison& run : regression.runs) {
    const RegressionCells cells = cells_of(run);
    table.add_row({run.run, to_string(run.verdict), cells.relative, cells.bias, cells.relight,
                   cells.precompute, cells.changed});
  }
  std::string text = count_line(regression);
  for (const std::string& note : regression.notes) text += "note: " + note + "\n";
  text += "\n" + table.to_string() + "\n";
  for (const RunComparison& run : regression.runs) text += details(run);
  return text;
}

}  // namespace relight
