#include "experiments/effects/loss_of_levels.h"

#include <algorithm>

#include "common/run/error.h"

namespace relight {

namespace {

std::vector<uint8_t> carried_groups(const EffectPaths& paths, const Levels& levels) {
  std::vector<uint8_t> carried;
  for (size_t g = 0; g < paths.groups(); ++g) carried.push_back(paths.carried(g, levels));
  return carried;
}

Image difference(const Image& a, const Image& b) {
  Image result = a;
  for (size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= b.pixels[i];
  return result;
}

}  // namespace

LossOfLevels::LossOfLevels(const std::vector<Effect>& effects, const EffectSite& site,
                           const LightByGroup& light, EffectPaths& paths, const Levels& everything)
    : effects_(effects),
      site_(site),
      light_(light),
      paths_(paths),
      everything_(everything),
      estimator_(light, carried_groups(paths, everything), static_cast<double>(site.scene.exposure)),
      lacks_(effects.size()) {
  for (size_t e = 0; e < effects.size(); ++e) {
    // Without a first level that may lose something there is nothing to measure.
    if (!effects[e].lacks || (effects[e].needless && !effects[e].needless(site).empty())) continue;
    lacks_[e] = effects[e].lacks(site);
    if (lacks_[e].size() != effects[e].levels.size())
      fail("effect '{}': {} images for {} levels", effects[e].name, lacks_[e].size(),
           effects[e].levels.size());
  }
}

LossInterval LossOfLevels::between(const Levels& from, const Levels& to) const {
  LossInterval loss = estimator_.lost(paths_.lost(from, to));
  for (size_t e = 0; e < effects_.size(); ++e)
    if (!lacks_[e].empty() && from[e] != to[e])
      loss = sum_of(loss, estimator_.lost(difference(lacks_[e][to[e]], lacks_[e][from[e]])));
  return loss;
}

LossInterval LossOfLevels::beyond() const {
  std::vector<uint8_t> beyond, all(paths_.groups(), 1);
  for (size_t g = 0; g < paths_.groups(); ++g) beyond.push_back(!paths_.carried(g, everything_));
  return LossEstimator(light_, all, static_cast<double>(site_.scene.exposure)).lost(beyond);
}

}  // namespace relight
