#include "experiments/effects/effect_paths.h"

#include <algorithm>

#include "common/run/error.h"

namespace relight {

namespace {

// Choices of levels that may be told apart: far above any method's, far below a table that hurts.
constexpr size_t most_choices = 65536;

}  // namespace

bool carries(const LightPaths& paths, const PathClass& c) {
  if (c.bounces < 0) return c.end == LightEnd::environment ? paths.environment : paths.emission;
  if (c.bounces > 0) {
    const int last = c.end == LightEnd::environment ? paths.last_environment_bounce() : paths.max_bounces;
    if (c.bounces < paths.min_bounces || c.bounces > last || c.or_more) return false;
    if (c.glossy_at_eye && !paths.glossy_at_eye) return false;
    if (c.glossy_interior && !paths.glossy_interior) return false;
  }
  return c.end != LightEnd::environment || paths.environment;
}

EffectPaths::EffectPaths(const Method& method, const KnobValues& knobs, const std::vector<Effect>& effects)
    : knobs_(knobs), effects_(effects) {
  size_t choices = 1;
  for (const Effect& e : effects) {
    if (e.levels.size() < 2)
      fail("{}: effect '{}' has {} levels; it needs at least two", method.name(), e.name, e.levels.size());
    choices *= e.levels.size();
    if (choices > most_choices) fail("{}: its effects have too many levels", method.name());
  }
  for (size_t n = 0; n < choices; ++n) {
    Levels levels;
    size_t rest = n;
    for (const Effect& e : effects) levels.push_back(rest % e.levels.size()), rest /= e.levels.size();
    paths_.push_back(method.light_paths(this->knobs(levels)));
  }
}

size_t EffectPaths::number(const Levels& levels) const {
  size_t number = 0, stride = 1;
  for (size_t e = 0; e < effects_.size(); ++e)
    number += levels.at(e) * stride, stride *= effects_[e].levels.size();
  return number;
}

Levels EffectPaths::everything() const {
  Levels levels;
  for (const Effect& e : effects_) levels.push_back(e.levels.size() - 1);
  return levels;
}

KnobValues EffectPaths::knobs(const Levels& levels) const {
  KnobValues knobs = knobs_;
  for (size_t e = 0; e < effects_.size(); ++e)
    for (const auto& [knob, value] : effects_[e].levels.at(levels.at(e)).knobs) knobs.set(knob, value);
  return knobs;
}

size_t EffectPaths::group_of(const PathClass& path_class) {
  std::vector<uint8_t> carried(paths_.size());
  std::transform(paths_.begin(), paths_.end(), carried.begin(),
                 [&](const LightPaths& p) { return static_cast<uint8_t>(carries(p, path_class)); });
  const auto [at, is_new] = groups_.try_emplace(std::string(carried.begin(), carried.end()), carried_.size());
  if (is_new) carried_.push_back(std::move(carried));
  return at->second;
}

std::vector<uint8_t> EffectPaths::lost(const Levels& from, const Levels& to) const {
  std::vector<uint8_t> lost;
  for (size_t g = 0; g < carried_.size(); ++g)
    lost.push_back(static_cast<uint8_t>(carried(g, from) && !carried(g, to)));
  return lost;
}

}  // namespace relight
