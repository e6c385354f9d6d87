// The pilot where its answer is known: a closed sphere with a lamp in its centre, in which every bounce gives
// an even radiance of albedo^k. Its light comes from real path traces, noise that pixels of a tile share
// included.
#include <gtest/gtest.h>

#include "common/run/stage_log.h"
#include "experiments/effects/planner.h"
#include "experiments/method_list.h"
#include "plan_cases.h"

namespace relight::test {
namespace {

constexpr float albedo = 0.5f;
constexpr int most = 4;

struct Known {
  MethodList methods = make_all_methods();
  const Method& method = find_method(methods, "path_tracing");
  KnobValues knobs{method.knobs()};
  std::vector<Effect> effects{bounces_effect("bounces_max", most)};
  tiny::Rendering sphere = lit_sphere(albedo, 8, 8);
  LightingState lighting = lamp_in_the_centre();
  Progress quiet{true};

  LossInterval loss_beyond(int bounces, uint64_t seed, int samples) {
    const EffectSite site{sphere.scene, sphere.tracer, sphere.buffer, lighting};
    EffectPaths paths(method, knobs, effects);
    Pilot pilot = make_pilot(site, paths, samples, seed, quiet);
    pilot.trace(8);
    const LossOfLevels loss(effects, site, pilot.light(), paths, paths.everything());
    return loss.between(paths.everything(), {static_cast<size_t>(bounces)});
  }
};

// 200 pilots of 64 pixels. Red if replicates share random numbers (tried: one seed for all), if
// the noise is counted as light, or if a bounce is counted with its neighbour.
TEST(PilotStatistics, IntervalsCoverTheKnownShareOfEveryBounce) {
  Known known;
  constexpr int seeds = 100;
  for (const int bounces : {0, 2}) {
    const double truth = share_of_bounces(albedo, bounces + 1, most);
    int covered = 0, too_low = 0;
    double sum = 0.0, squares = 0.0;
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      const LossInterval loss = known.loss_beyond(bounces, 77 + seed, 4);
      covered += loss.low <= truth && truth <= loss.high;
      too_low += loss.high < truth;
      sum += loss.value, squares += loss.value * loss.value;
    }
    const double mean = sum / seeds, error = std::sqrt((squares / seeds - mean * mean) / seeds);
    // Facets of the sphere send a little light elsewhere: 0.2 % of the share.
    EXPECT_NEAR(mean, truth, 4.0 * error + 0.002 * truth) << bounces;
    EXPECT_GE(covered, 0.88 * seeds) << bounces;  // 95 % less four deviations
    EXPECT_LE(too_low, 0.08 * seeds) << bounces;
  }
}

TEST(PilotStatistics, BeyondEverythingIsTheRestOfTheSeries) {
  Known known;
  const EffectSite site{known.sphere.scene, known.sphere.tracer, known.sphere.buffer, known.lighting};
  EffectPaths paths(known.method, known.knobs, known.effects);
  Pilot pilot = make_pilot(site, paths, 16, 5, known.quiet);
  pilot.trace(16);
  const LossOfLevels loss(known.effects, site, pilot.light(), paths, paths.everything());
  const LossInterval beyond = loss.beyond();
  const double truth = share_of_bounces(albedo, most + 1, 64);
  EXPECT_NEAR(beyond.value, truth, 0.05 * truth);
  EXPECT_LT(beyond.high - beyond.low, 0.1 * truth);
}

}  // namespace
}  // namespace relight::test
