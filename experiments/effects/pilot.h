// Independent small path traces of one view, light told apart by groups of path classes.
#pragma once

#include <vector>

#include "common/run/effects.h"
#include "common/run/progress.h"
#include "experiments/effects/effect_paths.h"

namespace relight {

// Light of each group in each of several independent pictures [replicate][group]; a group that a replicate
// has nothing of may be missing at the end.
struct LightByGroup {
  int width = 0, height = 0;
  std::vector<std::vector<Image>> replicates;
  int64_t samples = 0;  // paths a pixel, all replicates together
  int64_t rays = 0;
  int64_t non_finite = 0;  // samples replaced by zero
};

class Pilot {
 public:
  // paths: what is traced. told_apart: up to how many bounces. seed: independent of everything else's.
  // References must outlive this.
  Pilot(const EffectSite& site, const LightPaths& paths, int told_apart, int samples_a_replicate,
        uint64_t seed, EffectPaths& groups, Progress& progress);
  // Traces until there are this many replicates. The same seed gives the same bits for any number of threads.
  void trace(int replicates);
  const LightByGroup& light() const { return light_; }

 private:
  void add_replicate();
  EffectSite site_;
  LightPaths paths_;
  int told_apart_, samples_;
  uint64_t seed_;
  EffectPaths& groups_;
  Progress& progress_;
  LightByGroup light_;
};

// A view like `view` with at most `pixels` pixels, or the same.
View smaller_view(const View& view, int pixels);

}  // namespace relight
