#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run/atomic_file.h"
#include "experiments/explain/explain.h"
#include "experiments/options/csv_cell.h"

namespace relight {
namespace {

using Json = nlohmann::ordered_json;

// Empty where there is nothing to tell.
std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }

std::string percents(const Measures& measures) {
  std::string text;
  for (const double m : measures) text += "," + cell(100.0 * m);
  return text;
}

const Measures nothing = {NAN, NAN, NAN};

std::string csv_line(const std::string& kind, const WaterfallRow& row, bool alone) {
  return fmt::format("{},{},{}{}{}{}{}{},{},{},{}\n", kind, csv_cell(row.name), row.active ? "yes" : "no",
                     percents(row.points), percents(row.half_width), percents(row.change),
                     percents(alone ? row.alone_points : nothing),
                     percents(alone ? row.alone_change : nothing), cell(row.precompute_saved_s),
                     cell(row.relight_saved_ms), csv_cell(row.sentence));
}

// JSON has no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Measures& measures) {
  Json json = Json::object();
  for (size_t m = 0; m < measure_count; ++m) json[measure_names()[m]] = number(measures[m]);
  return json;
}

Json to_json(const WaterfallRow& row) {
  Json json = {{"stage", row.name}, {"sentence", row.sentence}, {"active", row.active}};
  json["points"] = to_json(row.points);
  json["half_width"] = to_json(row.half_width);
  json["change"] = to_json(row.change);
  json["alone_points"] = to_json(row.alone_points);
  json["alone_change"] = to_json(row.alone_change);
  json["precompute_saved_s"] = row.precompute_saved_s ? number(*row.precompute_saved_s) : Json(nullptr);
  json["relight_saved_ms"] = row.relight_saved_ms ? number(*row.relight_saved_ms) : Json(nullptr);
  return json;
}

Json to_json(const SettingRecord& setting) {
  Json json = {{"setting", setting.label}, {"knobs", setting.knobs}};
  json["precompute_s"] = number(setting.precompute_s);
  json["relight_ms"] = {{"median", number(setting.relight_ms.median)},
                        {"min", number(setting.relight_ms.min)},
                        {"max", number(setting.relight_ms.max)},
                        {"repeats", setting.relight_ms.repeats}};
  for (const auto& [stage, seconds] : setting.precompute_stages) json["precompute_stages"][stage] = seconds;
  for (const auto& [stage, seconds] : setting.relight_stages) json["relight_stages"][stage] = seconds;
  return json;
}

}  // namespace

std::string waterfall_csv(const Explanation& e) {
  std::string text = "kind,stage,active";
  for (const char* what : {"points", "half_width", "change", "alone_points", "alone_change"})
    for (const std::string& measure : measure_names()) text += fmt::format(",{}_{}", what, measure);
  text += ",precompute_saved_s,relight_saved_ms,sentence\n";
  WaterfallRow asked;
  asked.name = "as asked", asked.sentence = "The method under the settings asked for, against the reference.";
  asked.points = asked.change = e.waterfall.asked;
  asked.half_width = e.waterfall.asked_half_width;
  text += csv_line("total", asked, false);
  for (const WaterfallRow& row : e.waterfall.stages) text += csv_line("stage", row, row.active);
  text += csv_line("remainder", e.waterfall.remainder, false);
  WaterfallRow model;
  model.name = "not simulated", model.points = model.change = e.model.share;
  model.half_width = e.model.half_width;
  model.sentence = model_sentence(e);
  text += csv_line("model", model, false);
  for (const auto& [name, error] : e.waterfall.closer) {
    WaterfallRow row;
    row.name = name, row.points = row.change = error, row.half_width = nothing;
    row.sentence = "What is left with this setting and all stages exact.";
    text += csv_line("closer", row, false);
  }
  return text;
}

std::string waterfall_json(const Explanation& e) {
  Json json = {{"pixels_asked", e.pixels_asked}, {"pixels", e.pixels}, {"blocks", e.blocks}};
  json["pixel_share"] = e.pixel_share;
  json["edge_share"] = e.edge_share;
  json["shared_s"] = e.shared_s;
  json["load_average"] = e.load_average;
  json["asked"] = to_json(e.waterfall.asked);
  json["asked_half_width"] = to_json(e.waterfall.asked_half_width);
  json["stages"] = Json::array();
  for (const WaterfallRow& row : e.waterfall.stages) json["stages"].push_back(to_json(row));
  json["remainder"] = to_json(e.waterfall.remainder);
  json["model"] = {{"share", to_json(e.model.share)},
                   {"half_width", to_json(e.model.half_width)},
                   {"paths", e.model.paths.to_string()},
                   {"sentence", model_sentence(e)},
                   {"seconds", e.model.seconds}};
  json["closer"] = Json::array();
  for (const auto& [name, error] : e.waterfall.closer)
    json["closer"].push_back({{"setting", name}, {"error", to_json(error)}});
  for (const SettingRecord& setting : e.settings) json["settings"].push_back(to_json(setting));
  json["run"] = Json::parse(record_to_json(e.run));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_explanation(const Explanation& e, const std::filesystem::path& folder) {
  write_text_atomically(folder / "waterfall.csv", waterfall_csv(e));
  write_text_atomically(folder / "waterfall.json", waterfall_json(e));
}

}  // namespace relight
