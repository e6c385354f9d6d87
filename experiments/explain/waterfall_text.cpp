#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/explain/explain.h"
#include "experiments/options/text_table.h"

namespace relight {
namespace {

std::string percent(double value) { return fmt::format("{:.3f}", 100.0 * value); }

std::vector<std::string> stage_cells(const WaterfallRow& row) {
  if (!row.active) return {row.name, "not active", "", "", "", "", "", "", "", ""};
  return {row.name,
          percent(row.points[Measure::relative]),
          percent(row.half_width[Measure::relative]),
          percent(row.points[Measure::relative_edges_out]),
          percent(row.points[Measure::indirect_linear]),
          percent(row.change[Measure::relative]),
          percent(row.alone_points[Measure::relative]),
          percent(row.alone_change[Measure::relative]),
          fmt::format("{:.2f}", *row.precompute_saved_s),
          fmt::format("{:.1f}", *row.relight_saved_ms)};
}

std::vector<std::string> total_cells(const std::string& name, const Measures& points, double half_width) {
  return {name,
          percent(points[Measure::relative]),
          std::isnan(half_width) ? "" : percent(half_width),
          percent(points[Measure::relative_edges_out]),
          percent(points[Measure::indirect_linear]),
          "",
          "",
          "",
          "",
          ""};
}

std::string what_was_run(const Explanation& e) {
  const RunRecord& run = e.run;
  return fmt::format(
      "{} on {} under {}, {}: {} pixels in {} blocks, {:.2f} % of the view, {:.1f} % of them edges\n"
      "reference: {} paths a pixel in {:.1f} s; its noise is {} % of the total, {} % without edges, {} % of "
      "the "
      "indirect light\n",
      run.method, run.scene, run.lighting, run.view, e.pixels, e.blocks, 100.0 * e.pixel_share,
      100.0 * e.edge_share, run.reference->samples, run.reference->seconds,
      percent(run.errors->noise_floor.relative), percent(run.errors->noise_floor.relative_edges_out),
      percent(run.errors_indirect->noise_floor.relative_hdr));
}

std::string model_text(const Explanation& e) {
  return fmt::format("not simulated: {} +- {} % ({} % of the indirect light). {}\n",
                     percent(e.model.share[Measure::relative]),
                     percent(e.model.half_width[Measure::relative]),
                     percent(e.model.share[Measure::indirect_linear]), model_sentence(e));
}

constexpr const char* how_to_read =
    "points: per cent of relative error that go when the stage is made exact, those above it being exact; "
    "they "
    "add up.\n"
    "+-: 95 % interval over the choice of pixels. change: RMS difference that the stage makes, of "
    "|reference|.\n"
    "alone: the same with all other stages exact. saves: against its exact twin, on these pixels only.\n";

}  // namespace

std::string model_sentence(const Explanation& e) {
  std::string left_out = fmt::format("{}", fmt::join(e.run.not_simulated, "; "));
  return fmt::format(
      "No part of the error above: what the method leaves out by its nature or its knobs, of the picture of "
      "every light path: {}.",
      left_out);
}

std::string waterfall_text(const Explanation& e) {
  TextTable table({"stage", "points", "+-", "edges out", "indirect", "change", "alone", "alone change",
                   "saves precompute s", "saves relight ms"});
  table.add_row(total_cells("as asked", e.waterfall.asked, e.waterfall.asked_half_width[Measure::relative]));
  for (const WaterfallRow& row : e.waterfall.stages) table.add_row(stage_cells(row));
  const WaterfallRow& rest = e.waterfall.remainder;
  table.add_row(total_cells("left: " + rest.name, rest.points, rest.half_width[Measure::relative]));
  table.add_row(total_cells("sum", sum_of_points(e.waterfall), NAN));
  for (const auto& [name, error] : e.waterfall.closer)
    table.add_row(total_cells("left with " + name, error, NAN));
  std::string text = what_was_run(e) + "\n" + table.to_string(1) + "\n" + how_to_read + model_text(e) + "\n";
  for (const WaterfallRow& row : e.waterfall.stages) text += fmt::format("{}: {}\n", row.name, row.sentence);
  text += fmt::format("{}: {}\n", rest.name, rest.sentence);
  for (const std::string& warning : e.run.warnings) text += fmt::format("warning: {}\n", warning);
  return text;
}

}  // namespace relight
