// Which effects of a scene a run simulates, why, and what leaving out the others was expected to cost and did
// cost: what the effect planner decides (docs/effects.md) and the run record keeps.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/run/error_stages.h"

namespace relight {

// Share of the picture that is lost, |clamp(e R) - clamp(e (R - lost))|_2 / |clamp(e R)|_2 with R the picture
// of everything that the method can do, e the scene's exposure and clamping to [0,1]: the `relative` metric.
// low and high: 95 % interval (each end is passed with 2.5 %). Without noise both equal value.
struct LossInterval {
  double value = 0.0, low = 0.0, high = 0.0;
};

// rule: the scene, the light or the view makes it certain; pilot: a small path trace; user: --effect or
// --set.
enum class DecidedBy { rule, pilot, user };
std::string to_string(DecidedBy by);

struct EffectDecision {
  std::string effect, sentence;
  std::string level;       // chosen
  std::string everything;  // the last level
  DecidedBy by = DecidedBy::pilot;
  std::string reason;                     // in words
  LossInterval loss;                      // of this level, the other effects complete
  std::optional<LossInterval> next_loss;  // of the whole plan with this effect one level lower
  bool undecided = false;                 // that interval holds the tolerance: computed to be safe
  KnobOverrides settings;                 // of the level; empty: the user's own --set stands
  std::optional<LossInterval> measured;   // like loss, after the run
};

// A lamp, and what is not done for it.
struct LightNote {
  std::string light, note;
};

// The same run with everything on, for comparison. Artefact cache unused on both sides.
struct EverythingRun {
  double precompute_s = 0.0, planned_precompute_s = 0.0;
  double relight_ms = 0.0, planned_relight_ms = 0.0;  // medians
  int64_t bytes = 0, planned_bytes = 0;               // sums of memory_bytes by artefact
  double picture_change =
      0.0;  // |planned - everything|_2 / |everything|_2 of the method's own pictures, clamped
};

// kept: the measured interval lies below the tolerance; broken: above it; open: it holds the tolerance.
enum class EffectVerdict { kept, broken, open };
std::string to_string(EffectVerdict verdict);

struct EffectCheck {
  LossInterval measured;  // of the whole plan, by an independent path trace at the run's own view
  EffectVerdict verdict = EffectVerdict::open;
  bool as_predicted = false;  // do the predicted and the measured interval overlap?
  int64_t samples = 0;        // paths a pixel
  double seconds = 0.0;
  std::optional<EverythingRun> everything;
};

struct EffectPlan {
  double tolerance = 0.01;
  std::map<std::string, std::string> asked;  // levels that --effect named
  std::vector<EffectDecision> effects;
  std::vector<LightNote> lights;
  std::string everything;  // light paths of all last levels, in words
  LossInterval loss;       // of the whole plan
  // Light of even more bounces than everything has, as a share of the picture with them; absent: not
  // measured.
  std::optional<LossInterval> beyond;
  // The pilot; samples 0: rules decided everything.
  int pilot_width = 0, pilot_height = 0;
  int64_t pilot_samples = 0;  // paths a pixel
  int64_t pilot_rays = 0;
  double seconds = 0.0;  // of planning
  std::vector<std::string> warnings;
  std::optional<EffectCheck> check;
};

// As one JSON object.
std::string effect_plan_to_json(const EffectPlan& plan);
// Throws Error naming the missing or mistyped field.
EffectPlan effect_plan_from_json(const std::string& text);

}  // namespace relight
