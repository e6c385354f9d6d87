#include <nlohmann/json.hpp>

#include "common/run/effect_plan.h"
#include "common/run/error.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* decided_by_names[] = {"rule", "pilot", "user"};
constexpr const char* verdict_names[] = {"kept", "broken", "open"};

template <typename Enum, size_t n>
Enum from_name(const char* const (&names)[n], const std::string& name) {
  for (size_t i = 0; i < n; ++i)
    if (name == names[i]) return static_cast<Enum>(i);
  fail("not an effect plan: '{}' is none of {}", name, fmt::join(names, ", "));
}

Json to_json(const LossInterval& loss) {
  return {{"value", loss.value}, {"low", loss.low}, {"high", loss.high}};
}

LossInterval loss_from(const Json& json) {
  return {json.at("value").get<double>(), json.at("low").get<double>(), json.at("high").get<double>()};
}

std::optional<LossInterval> loss_if(const Json& json, const char* name) {
  return json.contains(name) ? std::optional(loss_from(json[name])) : std::nullopt;
}

Json to_json(const EffectDecision& d) {
  Json json = {{"effect", d.effect},         {"sentence", d.sentence},        {"level", d.level},
               {"everything", d.everything}, {"decided_by", to_string(d.by)}, {"reason", d.reason},
               {"loss", to_json(d.loss)},    {"undecided", d.undecided},      {"settings", Json::object()}};
  for (const auto& [knob, value] : d.settings) json["settings"][knob] = value;
  if (d.next_loss) json["next_loss"] = to_json(*d.next_loss);
  if (d.measured) json["measured"] = to_json(*d.measured);
  return json;
}

EffectDecision decision_from(const Json& json) {
  EffectDecision d;
  json.at("effect").get_to(d.effect);
  json.at("sentence").get_to(d.sentence);
  json.at("level").get_to(d.level);
  json.at("everything").get_to(d.everything);
  d.by = from_name<DecidedBy>(decided_by_names, json.at("decided_by").get<std::string>());
  json.at("reason").get_to(d.reason);
  d.loss = loss_from(json.at("loss"));
  json.at("undecided").get_to(d.undecided);
  for (const auto& [knob, value] : json.at("settings").items())
    d.settings.emplace_back(knob, value.get<std::string>());
  d.next_loss = loss_if(json, "next_loss");
  d.measured = loss_if(json, "measured");
  return d;
}

// One list for writing and reading.
constexpr std::pair<const char*, double EverythingRun::*> everything_fields[] = {
    {"precompute_s", &EverythingRun::precompute_s},
    {"planned_precompute_s", &EverythingRun::planned_precompute_s},
    {"relight_ms", &EverythingRun::relight_ms},
    {"planned_relight_ms", &EverythingRun::planned_relight_ms},
    {"picture_change", &EverythingRun::picture_change}};

Json to_json(const EffectCheck& check) {
  Json json = {{"measured", to_json(check.measured)},
               {"verdict", to_string(check.verdict)},
               {"as_predicted", check.as_predicted},
               {"samples", check.samples},
               {"seconds", check.seconds}};
  if (!check.everything) return json;
  Json& run = json["everything"];
  for (const auto& [name, field] : everything_fields) run[name] = (*check.everything).*field;
  run["bytes"] = check.everything->bytes;
  run["planned_bytes"] = check.everything->planned_bytes;
  return json;
}

EffectCheck check_from(const Json& json) {
  EffectCheck check;
  check.measured = loss_from(json.at("measured"));
  check.verdict = from_name<EffectVerdict>(verdict_names, json.at("verdict").get<std::string>());
  json.at("as_predicted").get_to(check.as_predicted);
  json.at("samples").get_to(check.samples);
  json.at("seconds").get_to(check.seconds);
  if (!json.contains("everything")) return check;
  const Json& run = json["everything"];
  check.everything.emplace();
  for (const auto& [name, field] : everything_fields) (*check.everything).*field = run.at(name).get<double>();
  run.at("bytes").get_to(check.everything->bytes);
  run.at("planned_bytes").get_to(check.everything->planned_bytes);
  return check;
}

EffectPlan plan_from(const Json& json) {
  EffectPlan plan;
  json.at("tolerance").get_to(plan.tolerance);
  json.at("asked").get_to(plan.asked);
  for (const Json& d : json.at("effects")) plan.effects.push_back(decision_from(d));
  for (const Json& l : json.at("lights"))
    plan.lights.push_back({l.at("light").get<std::string>(), l.at("note").get<std::string>()});
  json.at("everything").get_to(plan.everything);
  plan.loss = loss_from(json.at("loss"));
  plan.beyond = loss_if(json, "beyond");
  const Json& pilot = json.at("pilot");
  pilot.at("width").get_to(plan.pilot_width);
  pilot.at("height").get_to(plan.pilot_height);
  pilot.at("samples").get_to(plan.pilot_samples);
  pilot.at("rays").get_to(plan.pilot_rays);
  json.at("seconds").get_to(plan.seconds);
  json.at("warnings").get_to(plan.warnings);
  if (json.contains("check")) plan.check = check_from(json["check"]);
  return plan;
}

}  // namespace

std::string to_string(DecidedBy by) { return decided_by_names[static_cast<size_t>(by)]; }
std::string to_string(EffectVerdict verdict) { return verdict_names[static_cast<size_t>(verdict)]; }

std::string effect_plan_to_json(const EffectPlan& plan) {
  Json json = {{"tolerance", plan.tolerance}, {"asked", plan.asked}, {"effects", Json::array()}};
  for (const EffectDecision& d : plan.effects) json["effects"].push_back(to_json(d));
  json["lights"] = Json::array();
  for (const LightNote& l : plan.lights) json["lights"].push_back({{"light", l.light}, {"note", l.note}});
  json["everything"] = plan.everything;
  json["loss"] = to_json(plan.loss);
  if (plan.beyond) json["beyond"] = to_json(*plan.beyond);
  json["pilot"] = {{"width", plan.pilot_width},
                   {"height", plan.pilot_height},
                   {"samples", plan.pilot_samples},
                   {"rays", plan.pilot_rays}};
  json["seconds"] = plan.seconds;
  json["warnings"] = plan.warnings;
  if (plan.check) json["check"] = to_json(*plan.check);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

EffectPlan effect_plan_from_json(const std::string& text) {
  try {
    return plan_from(Json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    fail("not an effect plan: {}", error.what());
  }
}

}  // namespace relight
