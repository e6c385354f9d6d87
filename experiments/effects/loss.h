// How much of a picture some of its light is, with an interval, from independent noisy pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "common/run/effect_plan.h"
#include "experiments/effects/pilot.h"

namespace relight {

// Of K replicates with lost light L_k and whole light R_k, in exposed units, R their mean:
//   d_k = L_k - max(0, R - 1), 0 where R - L >= 1       (what the clamp to [0,1] lets through)
//   numerator   = sum over pixels and channels of sum_{j != k} d_j d_k / (K (K - 1))
//   denominator = sum of min(1, R)^2, less the variance of R where R < 1
// The squared norm of a noisy mean is too large by its noise; products of different replicates are not,
// whatever the noise is like and however pixels share it. The standard error of the quotient is that of a
// delete-one jackknife over replicates; ends of the interval are those of Student's t with K - 1 degrees of
// freedom, under the root and not below zero. What no replicate has found does not count: an interval is no
// better than the paths that were traced.
class LossEstimator {
 public:
  // everything: for each group, 1 if it is part of the whole picture. `light` must outlive this; at least
  // three replicates.
  LossEstimator(const LightByGroup& light, std::vector<uint8_t> everything, double exposure);
  LossEstimator(LightByGroup&&, std::vector<uint8_t>, double) = delete;

  // Of the groups marked 1.
  LossInterval lost(const std::vector<uint8_t>& groups) const;
  // Of an image without noise (radiance).
  LossInterval lost(const Image& lacking) const;

 private:
  std::vector<Image> chosen_light(const std::vector<uint8_t>& groups) const;

  const LightByGroup& light_;
  std::vector<Image> whole_;  // a replicate
  double exposure_;
};

// Two-sided 95 % quantile of Student's t, within 0.2 % from 7 degrees of freedom on.
double student_quantile_95(int degrees_of_freedom);

// Of norms that may add up in the worst case (triangle inequality).
LossInterval sum_of(const LossInterval& a, const LossInterval& b);

}  // namespace relight
