// Direct light of a lighting that changes little from call to call: keeps the sum that LightCache plans for.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "common/run/stage_log.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/light_cache.h"

namespace relight {

// Result: where light is added up, on the CPU or the GPU. Shader has
//   Result make() const;                                            contents undefined
//   void shade(const std::vector<Light>&, Result&, Onto, StageLog&);
//   void copy(const Result& from, Result& to) const;
// and Result has int64_t bytes() const.
template <typename Result>
class CachedDirectLight {
 public:
  explicit CachedDirectLight(Result result) : fresh_(std::move(result)) {}

  // The light of `lighting`; valid until the next call. Equal to shading everything afresh except for the
  // rounding of sums in another order: 2^-23 of the sum of the lights' radiances for each light. Counts
  // lights_shaded and lights_cached.
  template <typename Shader>
  const Result& shade(Shader& shader, const LightingState& lighting, StageLog& log) {
    const LightCache::Plan plan = cache_.plan(lighting);
    const Result& result = plan.uses_sum() ? from_sum(shader, plan, log) : fresh(shader, plan, log);
    cache_.done();
    log.count("lights_shaded", plan.shaded());
    log.count("lights_cached", plan.cached);
    return result;
  }
  void forget() { cache_.forget(); }
  int64_t bytes() const { return fresh_.bytes() + (sum_ ? sum_->bytes() : 0); }

 private:
  template <typename Shader>
  const Result& fresh(Shader& shader, const LightCache::Plan& plan, StageLog& log) {
    shader.shade(plan.on_top, fresh_, Onto::nothing, log);
    return fresh_;
  }

  template <typename Shader>
  const Result& from_sum(Shader& shader, const LightCache::Plan& plan, StageLog& log) {
    if (!sum_) sum_.emplace(shader.make());
    shader.shade(plan.into_sum, *sum_, plan.from_zero ? Onto::nothing : Onto::what_is_there, log);
    if (plan.on_top.empty()) return *sum_;
    shader.copy(*sum_, fresh_);
    shader.shade(plan.on_top, fresh_, Onto::what_is_there, log);
    return fresh_;
  }

  LightCache cache_;
  Result fresh_;
  std::optional<Result> sum_;  // made when first needed
};

}  // namespace relight
