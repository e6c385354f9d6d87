// What a search found, as text, CSV, JSON and Markdown.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiments/options/csv_cell.h"
#include "experiments/options/text_table.h"
#include "experiments/tune/tune.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{:.3g}", value); }

std::string percent(const Outcome& o) {
  return std::isnan(o.error) ? "" : fmt::format("{:.2f} +- {:.2f} %", 100.0 * o.error, 100.0 * o.half_width);
}

std::string setting_text(const TuneResult::Line& line) {
  std::string text;
  for (const auto& [knob, value] : line.changed) text += (text.empty() ? "" : " ") + knob + "=" + value;
  return text.empty() ? "defaults" : text;
}

std::string verdict(const Outcome& outcome, const TuneBounds& bounds) {
  return violation(outcome, bounds) == 0.0
             ? "keeps the bounds"
             : fmt::format("{}", fmt::join(broken_bounds(outcome, bounds), ", "));
}

std::string bounds_text(const TunePlan& plan) {
  std::string text =
      fmt::format("{} error at most {:.3g} %", to_string(plan.metric), 100.0 * plan.bounds.error);
  if (plan.bounds.relight_ms) text += fmt::format(", relight at most {:.3g} ms", *plan.bounds.relight_ms);
  if (plan.bounds.memory_mb) text += fmt::format(", memory at most {:.3g} MB", *plan.bounds.memory_mb);
  if (plan.bounds.precompute_s)
    text += fmt::format(", precompute at most {:.3g} s", *plan.bounds.precompute_s);
  return text + fmt::format("; least {}", to_string(plan.bounds.minimise));
}

// Indices of what was tried, the best first.
std::vector<size_t> ranked(const TunePlan& plan, const TuneResult& result) {
  std::vector<size_t> order(result.tried.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return better(result.tried[a].outcome, result.tried[b].outcome, plan.bounds, 0.0);
  });
  return order;
}

// "met on 3 of 4 lightings that the search did not see (open on 1)".
std::string verified_text(const TuneResult& result) {
  const auto count = [&](BoundVerdict v) {
    return std::count_if(result.verified.begin(), result.verified.end(),
                         [&](const Verification& x) { return x.verdict == v; });
  };
  std::string text = fmt::format("met on {} of {} lightings that the search did not see", result.met(),
                                 result.verified.size());
  if (const auto open = count(BoundVerdict::open))
    text += fmt::format("; open on {}: the interval holds the bound", open);
  return text;
}

std::string choice_text(const TunePlan& plan, const TuneResult& result) {
  if (result.chosen == SIZE_MAX) return "nothing was measured within the budget";
  const TuneResult::Line& line = result.tried[result.chosen];
  if (result.keeps_bounds)
    return fmt::format("Cheapest setting found: {} {} ({}, error {})", line.method, setting_text(line),
                       cost_text(line.outcome, plan.bounds.minimise), percent(line.outcome));
  return fmt::format("No setting that was tried keeps all bounds. The closest: {} {}, which breaks: {}",
                     line.method, setting_text(line), verdict(line.outcome, plan.bounds));
}

std::vector<std::string> notes(const TunePlan& plan, const TuneResult& result) {
  std::vector<std::string> texts;
  for (const std::string& method : result.unfinished)
    texts.push_back(
        fmt::format("the budget ({} runs, {:.0f} s, shared by the methods) ended the search of {}", plan.runs,
                    plan.budget_s, method));
  return texts;
}

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Outcome& o) {
  return {{"error", json_number(o.error)},
          {"half_width", json_number(o.half_width)},
          {"relight_ms", json_number(o.relight_ms)},
          {"memory_mb", json_number(o.memory_mb)},
          {"precompute_s", json_number(o.precompute_s)},
          {"failure", o.failure}};
}

}  // namespace

std::string tune_text(const TunePlan& plan, const TuneResult& result) {
  TextTable table({"method", "setting", "error", "relight ms", "MB", "precompute s", "verdict"});
  for (const size_t i : ranked(plan, result)) {
    const TuneResult::Line& l = result.tried[i];
    table.add_row({(i == result.chosen ? "* " : "  ") + l.method, setting_text(l), percent(l.outcome),
                   number(l.outcome.relight_ms), number(l.outcome.memory_mb), number(l.outcome.precompute_s),
                   verdict(l.outcome, plan.bounds)});
  }
  std::string text = fmt::format("{}, lights {}, view {}\n{}\n\n{} settings, the best first:\n{}\n{}\n",
                                 result.scene, result.lights, result.view, bounds_text(plan),
                                 result.tried.size(), table.to_string(), choice_text(plan, result));
  for (const std::string& note : notes(plan, result)) text += "note: " + note + "\n";
  if (result.chosen != SIZE_MAX) text += "\n" + result.tried[result.chosen].command + "\n";
  if (result.verified.empty()) return text;
  TextTable verified({"lights", "error", "relight ms",
                      "error at most " + fmt::format("{:.3g} %", 100.0 * plan.bounds.error)});
  for (const Verification& v : result.verified)
    verified.add_row({v.lights, percent(v.outcome), number(v.outcome.relight_ms),
                      v.outcome.failure.empty() ? to_string(v.verdict) : "failed: " + v.outcome.failure});
  return text + fmt::format("\n{}\n{}\n", verified.to_string(), verified_text(result));
}

std::string tune_csv(const TunePlan& plan, const TuneResult& result) {
  std::string text =
      "phase,lights,method,setting,why,error,half_width,relight_ms,memory_mb,precompute_s,verdict,chosen,"
      "command\n";
  const auto numbers = [](const Outcome& o) {
    const auto cell = [](double v) { return std::isfinite(v) ? fmt::format("{:.6g}", v) : ""; };
    return fmt::format("{},{},{},{},{}", cell(o.error), cell(o.half_width), cell(o.relight_ms),
                       cell(o.memory_mb), cell(o.precompute_s));
  };
  for (size_t i = 0; i < result.tried.size(); ++i) {
    const TuneResult::Line& l = result.tried[i];
    text += fmt::format("search,{},{},{},{},{},{},{},{}\n", csv_cell(result.lights), l.method,
                        csv_cell(setting_text(l)), csv_cell(l.why), numbers(l.outcome),
                        csv_cell(verdict(l.outcome, plan.bounds)), i == result.chosen ? "yes" : "no",
                        csv_cell(l.command));
  }
  for (const Verification& v : result.verified) {
    const TuneResult::Line& l = result.tried[result.chosen];
    text += fmt::format("verify,{},{},{},{},{},{},yes,\n", csv_cell(v.lights), l.method,
                        csv_cell(setting_text(l)), csv_cell("lights that the search did not see"),
                        numbers(v.outcome), to_string(v.verdict));
  }
  return text;
}

std::string tune_json(const TunePlan& plan, const TuneResult& result) {
  Json json = {
      {"scene", result.scene}, {"lights", result.lights}, {"view", result.view}, {"command", plan.command}};
  json["bounds"] = {{"error", plan.bounds.error},
                    {"metric", to_string(plan.metric)},
                    {"minimise", to_string(plan.bounds.minimise)}};
  if (plan.bounds.relight_ms) json["bounds"]["relight_ms"] = *plan.bounds.relight_ms;
  if (plan.bounds.memory_mb) json["bounds"]["memory_mb"] = *plan.bounds.memory_mb;
  if (plan.bounds.precompute_s) json["bounds"]["precompute_s"] = *plan.bounds.precompute_s;
  json["keeps_bounds"] = result.keeps_bounds;
  json["unfinished"] = result.unfinished;
  json["tried"] = Json::array();
  for (size_t i = 0; i < result.tried.size(); ++i) {
    const TuneResult::Line& l = result.tried[i];
    json["tried"].push_back({{"method", l.method},
                             {"changed", l.changed},
                             {"why", l.why},
                             {"outcome", to_json(l.outcome)},
                             {"violation", json_number(violation(l.outcome, plan.bounds))},
                             {"breaks", broken_bounds(l.outcome, plan.bounds)},
                             {"chosen", i == result.chosen},
                             {"command", l.command}});
  }
  json["verified"] = Json::array();
  for (const Verification& v : result.verified)
    json["verified"].push_back(
        {{"lights", v.lights}, {"outcome", to_json(v.outcome)}, {"verdict", to_string(v.verdict)}});
  json["provenance"] = {{"commit", result.provenance.commit},
                        {"cpu", result.provenance.cpu},
                        {"threads", result.provenance.threads},
                        {"date", result.provenance.date}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string tune_markdown(const TunePlan& plan, const TuneResult& result) {
  std::string text = fmt::format("# Tuning on {}, lights {}, view {}\n\n{}.\n\n{}.\n", result.scene,
                                 result.lights, result.view, bounds_text(plan), choice_text(plan, result));
  for (const std::string& note : notes(plan, result)) text += fmt::format("\nNote: {}.\n", note);
  if (result.chosen != SIZE_MAX)
    text += fmt::format("\n```sh\n{}\n```\n", result.tried[result.chosen].command);
  if (!result.verified.empty()) {
    text += fmt::format(
        "\nThe error bound was {}.\n\n| lights | error | relight [ms] | verdict |\n|---|---|---|---|\n",
        verified_text(result));
    for (const Verification& v : result.verified)
      text += fmt::format("| {} | {} | {} | {} |\n", v.lights, percent(v.outcome),
                          number(v.outcome.relight_ms), to_string(v.verdict));
  }
  text +=
      "\n| method | setting | why | error | relight [ms] | memory [MB] | precompute [s] | verdict |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const size_t i : ranked(plan, result)) {
    const TuneResult::Line& l = result.tried[i];
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", l.method, setting_text(l), l.why,
                        percent(l.outcome), number(l.outcome.relight_ms), number(l.outcome.memory_mb),
                        number(l.outcome.precompute_s), verdict(l.outcome, plan.bounds));
  }
  return text + fmt::format("\nMade by `{}`.\n", plan.command);
}

}  // namespace relight
