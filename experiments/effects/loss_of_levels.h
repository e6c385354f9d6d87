// What a choice of levels loses: light paths measured by a pilot, and what effects tell of themselves.
#pragma once

#include <memory>
#include <vector>

#include "experiments/effects/effect_paths.h"
#include "experiments/effects/loss.h"
#include "experiments/effects/pilot.h"

namespace relight {

class LossOfLevels {
 public:
  // everything: levels that the whole picture has. References must outlive this.
  LossOfLevels(const std::vector<Effect>& effects, const EffectSite& site, const LightByGroup& light,
               EffectPaths& paths, const Levels& everything);
  // Of light that `from` has and `to` has not, as a share of the whole picture. Losses of different effects
  // that are not told apart by light paths add up as in the worst case.
  LossInterval between(const Levels& from, const Levels& to) const;
  // Of light of more bounces than `everything` has, as a share of the picture with it.
  LossInterval beyond() const;

 private:
  const std::vector<Effect>& effects_;
  const EffectSite& site_;
  const LightByGroup& light_;
  const EffectPaths& paths_;
  Levels everything_;
  LossEstimator estimator_;
  std::vector<std::vector<Image>> lacks_;  // of each effect that brings them, by level
};

}  // namespace relight
