#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "common/image/metric_fields.h"
#include "common/run/error.h"
#include "common/run/run_record.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double number_from(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const std::string word = json.get<std::string>();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  fail("'{}' is not a number", word);
}

constexpr std::pair<const char*, std::string Provenance::*> provenance_fields[] = {
    {"commit", &Provenance::commit},
    {"compiler", &Provenance::compiler},
    {"build_type", &Provenance::build_type},
    {"cpu", &Provenance::cpu},
    {"gl_renderer", &Provenance::gl_renderer},
    {"gl_version", &Provenance::gl_version},
    {"date", &Provenance::date}};

Json metrics_to_json(const MetricSet& metrics) {
  Json json = Json::object();
  for (const auto& [name, field] : metric_fields) json[name] = number(metrics.*field);
  return json;
}

MetricSet metrics_from_json(const Json& json) {
  MetricSet metrics;
  for (const auto& [name, field] : metric_fields) metrics.*field = number_from(json.at(name));
  return metrics;
}

Json errors_to_json(const ErrorReport& report) {
  Json json = metrics_to_json(report.value);
  json["noise_floor"] = metrics_to_json(report.noise_floor);
  json["half_width"] = metrics_to_json(report.half_width);
  json["edge_share"] = number(report.edge_share);
  json["non_finite"] = report.non_finite;
  return json;
}

ErrorReport errors_from_json(const Json& json) {
  ErrorReport report;
  report.value = metrics_from_json(json);
  report.noise_floor = metrics_from_json(json.at("noise_floor"));
  report.half_width = metrics_from_json(json.at("half_width"));
  report.edge_share = number_from(json.at("edge_share"));
  report.non_finite = json.at("non_finite").get<int64_t>();
  return report;
}

using Stages = std::vector<std::pair<std::string, double>>;

Json stages_to_json(const Stages& stages) {
  Json json = Json::object();
  for (const auto& [name, seconds] : stages) json[name] = number(seconds);
  return json;
}

Stages stages_from_json(const Json& json) {
  Stages stages;
  for (const auto& [name, seconds] : json.items()) stages.emplace_back(name, number_from(seconds));
  return stages;
}

Json time_to_json(const RunRecord& record) {
  const RelightTime& relight = record.relight_ms;
  return {{"precompute_s", number(record.precompute_s)},
          {"relight_ms",
           {{"median", number(relight.median)},
            {"min", number(relight.min)},
            {"max", number(relight.max)},
            {"repeats", relight.repeats}}},
          {"stages",
           {{"setup", stages_to_json(record.setup_stages)},
            {"precompute", stages_to_json(record.precompute_stages)},
            {"relight", stages_to_json(record.relight_stages)}}}};
}

void time_from_json(const Json& json, RunRecord& record) {
  record.precompute_s = number_from(json.at("precompute_s"));
  const Json& relight = json.at("relight_ms");
  record.relight_ms = {number_from(relight.at("median")), number_from(relight.at("min")),
                       number_from(relight.at("max")), relight.at("repeats").get<int>()};
  record.setup_stages = stages_from_json(json.at("stages").at("setup"));
  record.precompute_stages = stages_from_json(json.at("stages").at("precompute"));
  record.relight_stages = stages_from_json(json.at("stages").at("relight"));
}

Json provenance_to_json(const Provenance& provenance) {
  Json json = Json::object();
  for (const auto& [name, field] : provenance_fields) json[name] = provenance.*field;
  json["dirty"] = provenance.dirty;
  json["threads"] = provenance.threads;
  if (provenance.shared_machine) json["shared_machine"] = true;
  return json;
}

Provenance provenance_from_json(const Json& json) {
  Provenance provenance;
  for (const auto& [name, field] : provenance_fields) provenance.*field = json.at(name).get<std::string>();
  provenance.dirty = json.at("dirty").get<bool>();
  provenance.threads = json.at("threads").get<int>();
  provenance.shared_machine = json.value("shared_machine", false);
  return provenance;
}

RunRecord record_from(const Json& json) {
  RunRecord record;
  json.at("scene").get_to(record.scene);
  json.at("view").get_to(record.view);
  json.at("lighting").get_to(record.lighting);
  json.at("method").get_to(record.method);
  record.preset = json.value("preset", "");
  json.at("knobs").get_to(record.knobs);
  json.at("seed").get_to(record.seed);
  record.repeatable = json.value("repeatable", true);
  json.at("light_paths").get_to(record.light_paths);
  json.at("reference_paths").get_to(record.reference_paths);
  json.at("not_simulated").get_to(record.not_simulated);
  json.at("command").get_to(record.command);
  record.exposure = number_from(json.at("exposure"));
  json.at("width").get_to(record.width);
  json.at("height").get_to(record.height);
  json.at("triangles").get_to(record.triangles);
  json.at("scene_hash").get_to(record.scene_hash);
  record.view_hash = json.value("view_hash", "");
  record.lighting_hash = json.value("lighting_hash", "");
  if (json.contains("effect_plan")) record.effect_plan = effect_plan_from_json(json["effect_plan"].dump());
  if (json.contains("errors")) record.errors = errors_from_json(json["errors"]);
  if (json.contains("errors_indirect")) record.errors_indirect = errors_from_json(json["errors_indirect"]);
  time_from_json(json.at("time"), record);
  json.at("memory_bytes").get_to(record.memory_bytes);
  json.at("counters").get_to(record.counters);
  if (json.contains("reference")) {
    const Json& cost = json["reference"];
    record.reference = {cost.at("samples").get<int64_t>(),       cost.at("batches").get<int64_t>(),
                        number_from(cost.at("seconds")),         cost.at("rays").get<int64_t>(),
                        cost.at("estimator").get<std::string>(), cost.at("from_cache").get<bool>()};
  }
  json.at("warnings").get_to(record.warnings);
  json.at("failed_stages").get_to(record.failed_stages);
  record.provenance = provenance_from_json(json.at("provenance"));
  return record;
}

}  // namespace

int64_t prepared_bytes(const RunRecord& record) {
  int64_t bytes = 0;
  for (const auto& [artefact, n] : record.memory_bytes) bytes += artefact == "process_peak" ? 0 : n;
  return bytes;
}

std::string record_to_json(const RunRecord& record) {
  Json json = {{"scene", record.scene},
               {"view", record.view},
               {"lighting", record.lighting},
               {"method", record.method},
               {"preset", record.preset},
               {"knobs", record.knobs},
               {"seed", record.seed},
               {"light_paths", record.light_paths},
               {"reference_paths", record.reference_paths},
               {"not_simulated", record.not_simulated},
               {"command", record.command},
               {"exposure", number(record.exposure)},
               {"width", record.width},
               {"height", record.height},
               {"triangles", record.triangles},
               {"scene_hash", record.scene_hash},
               {"view_hash", record.view_hash},
               {"lighting_hash", record.lighting_hash}};
  if (!record.repeatable) json["repeatable"] = false;
  if (record.effect_plan) json["effect_plan"] = Json::parse(effect_plan_to_json(*record.effect_plan));
  if (record.errors) json["errors"] = errors_to_json(*record.errors);
  if (record.errors_indirect) json["errors_indirect"] = errors_to_json(*record.errors_indirect);
  json["time"] = time_to_json(record);
  json["memory_bytes"] = record.memory_bytes;
  json["counters"] = record.counters;
  if (const auto& cost = record.reference)
    json["reference"] = {{"samples", cost->samples},         {"batches", cost->batches},
                         {"seconds", number(cost->seconds)}, {"rays", cost->rays},
                         {"estimator", cost->estimator},     {"from_cache", cost->from_cache}};
  json["warnings"] = record.warnings;
  json["failed_stages"] = record.failed_stages;
  json["provenance"] = provenance_to_json(record.provenance);
  // A file name in another encoding must not lose the record: bytes that are not UTF-8 are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

RunRecord record_from_json(const std::string& line) {
  try {
    return record_from(Json::parse(line));
  } catch (const nlohmann::json::exception& error) {
    fail("not a run record: {}", error.what());
  }
}

RelightTime summarise_times(const std::vector<double>& milliseconds) {
  if (milliseconds.empty()) return {};
  std::vector<double> sorted = milliseconds;
  std::sort(sorted.begin(), sorted.end());
  const size_t half = sorted.size() / 2;
  const double median = sorted.size() % 2 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
  return {median, sorted.front(), sorted.back(), static_cast<int>(sorted.size())};
}

}  // namespace relight
