#include "experiments/effects/planner.h"

#include <algorithm>

#include "experiments/options/parse.h"
#include "experiments/usage_error.h"
#include "reference/direct_image.h"

namespace relight {

namespace {

// Beyond this no light is left at any albedo that real surfaces have.
constexpr int longest_paths = 64;

// Every class that paths up to `bounces` bounces can have, whatever the scene.
std::vector<PathClass> all_classes(int bounces) {
  LightPaths paths;
  paths.max_bounces = bounces;
  paths.glossy_at_eye = paths.glossy_interior = paths.environment = paths.emission = true;
  std::vector<PathClass> classes = PathClasses(bounces, paths, true, true, true).classes();
  for (const PathClass& c : DirectImage::classes()) classes.push_back(c);
  for (const PathClass& c : DirectImage::area_classes()) classes.push_back(c);
  return classes;
}

bool uses_any(const Effect& effect, const std::set<std::string>& knobs, std::string& which) {
  for (const EffectLevel& level : effect.levels)
    for (const auto& [knob, value] : level.knobs)
      if (knobs.count(knob)) {
        which = knob;
        return true;
      }
  return false;
}

// Why none of the classes that lie between the two paths can hold light; nothing if one may.
std::optional<std::string> why_nothing_lost(const LightPaths& from, const LightPaths& to,
                                            const SceneFacts& facts) {
  std::string reason;
  for (const PathClass& c : all_classes(from.max_bounces)) {
    if (!carries(from, c) || carries(to, c)) continue;
    const std::string why = why_impossible(c, facts);
    if (why.empty()) return std::nullopt;
    if (reason.find(why) == std::string::npos) reason += (reason.empty() ? "" : "; ") + why;
  }
  return reason.empty() ? "the other effects leave nothing for it to add" : reason;
}

}  // namespace

PlannableEffects plannable_effects(const EffectRequest& request) {
  PlannableEffects out;
  for (Effect& effect : request.method.effects(request.knobs)) {
    std::string knob;
    if (!uses_any(effect, request.fixed, knob)) {
      out.effects.push_back(std::move(effect));
      continue;
    }
    EffectDecision d;
    d.effect = effect.name, d.sentence = effect.sentence;
    d.level = fmt::format("{}={}", knob, request.knobs.all().at(knob));
    d.everything = effect.levels.back().name;
    d.by = DecidedBy::user;
    d.reason = fmt::format("--set {}.{} wins over any plan", request.method.name(), knob);
    if (request.asked.count(effect.name))
      usage_fail("--effect {}={}: --set {}.{} fixes the same knob; leave one of them out", effect.name,
                 request.asked.at(effect.name), request.method.name(), knob);
    out.fixed.push_back(std::move(d));
  }
  return out;
}

size_t find_level(const Effect& effect, const std::string& level) {
  std::string valid;
  for (size_t l = 0; l < effect.levels.size(); ++l) {
    if (effect.levels[l].name == level) return l;
    append_name(valid, effect.levels[l].name);
  }
  usage_fail("--effect {}={}: no such level; valid: {}", effect.name, level, valid);
}

Pilot make_pilot(const EffectSite& site, EffectPaths& paths, int samples, uint64_t seed, Progress& progress) {
  LightPaths traced = paths.paths(paths.everything());
  const int everything = traced.max_bounces;
  if (everything > 0) traced.max_bounces = std::max(everything, longest_paths);
  return Pilot(site, traced, everything, samples, seed, paths, progress);
}

Rule rule_for(size_t e, const std::vector<Effect>& effects, const EffectPaths& paths, const Levels& levels,
              const EffectSite& site, const SceneFacts& facts) {
  const Effect& effect = effects[e];
  if (effect.lacks) {
    std::string reason = effect.needless ? effect.needless(site) : "";
    return reason.empty() ? Rule{levels[e], ""} : Rule{0, std::move(reason)};
  }
  Levels lower = levels;
  for (lower[e] = 0; lower[e] < levels[e]; ++lower[e])
    if (auto reason = why_nothing_lost(paths.paths(levels), paths.paths(lower), facts))
      return {lower[e], std::move(*reason)};
  return {levels[e], ""};
}

}  // namespace relight
