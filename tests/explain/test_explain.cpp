// `explain` on a method whose errors are known.
#include <cmath>

#include <gtest/gtest.h>

#include "experiments/explain/explain.h"
#include "experiments/usage_error.h"
#include "explaining.h"

namespace relight::test {
namespace {

// One wrong stage: it and no other is blamed, alone as in the chain, and what is left is the noise of two
// path traced pictures. Indirect light times 0.8 is an error of 0.2 of the indirect light; noise moves that
// by less than its own size. Red if overrides reach another knob, or the subset of the method is not that of
// the reference (tried: another seed for one of them).
TEST(Explain, BlamesAPlantedErrorOnItsStageAndOnNoOther) {
  for (const std::string guilty : {"direct", "dim", "tint"}) {
    const Explanation e = Explaining({guilty}).run();
    const double noise = e.waterfall.remainder.points[Measure::relative];
    EXPECT_LT(noise, 3.0 * e.run.errors->noise_floor.relative);
    ASSERT_EQ(e.waterfall.stages.size(), 3u);
    for (const WaterfallRow& row : e.waterfall.stages) {
      EXPECT_EQ(row.active, row.name == guilty) << row.name;
      if (row.name != guilty) {
        EXPECT_EQ(row.points[Measure::relative], 0.0);
        continue;
      }
      EXPECT_GT(row.points[Measure::relative], 5.0 * noise) << guilty;
      EXPECT_EQ(row.alone_points, row.points);
      if (guilty == "dim") {
        EXPECT_NEAR(row.change[Measure::indirect_linear], 0.2, 0.01);
      } else if (guilty == "direct") {
        EXPECT_EQ(row.points[Measure::indirect_linear], 0.0);
      }
    }
  }
}

// All wrong at once: the points add up, and twice green undoes some of the dimming.
TEST(Explain, PointsOfInteractingErrorsAddUp) {
  const Explanation e = Explaining({"direct", "dim", "tint"}).run();
  const Measures sum = sum_of_points(e.waterfall);
  for (size_t m = 0; m < measure_count; ++m) EXPECT_NEAR(sum[m], e.waterfall.asked[m], 1e-12);
  EXPECT_NEAR(e.waterfall.asked[Measure::relative], e.run.errors->value.relative, 1e-9);
  EXPECT_EQ(e.settings.size(), 6u)
      << "asked, 3 in the chain, 2 alone: the last one alone is the chain's second last";
}

// Red if a precompute is timed that another setting has made, or a relight knob is charged for one (tried:
// each setting's own time).
TEST(Explain, OnlyPrecomputeKnobsAreChargedForPrecompute) {
  const Explanation e = Explaining({"direct", "dim", "tint"}).run();
  EXPECT_EQ(*e.waterfall.stages[0].precompute_saved_s, 0.0);
  EXPECT_GT(*e.waterfall.stages[1].precompute_saved_s, 0.02);
  EXPECT_EQ(*e.waterfall.stages[2].precompute_saved_s, 0.0);
}

// Red if the choice of pixels or anything else depends on threads or the time of day.
TEST(Explain, SameSeedSameNumbersForOneAndTwoThreads) {
  Explaining one({"tint"}), two({"tint"});
  one.options.session.threads = 1;
  two.options.session.threads = 2;
  const Explanation a = one.run(), b = two.run();
  EXPECT_EQ(a.waterfall.asked, b.waterfall.asked);
  EXPECT_EQ(a.waterfall.remainder.points, b.waterfall.remainder.points);
}

TEST(Explain, ANonFinitePixelIsAnErrorThatNamesTheSetting) {
  try {
    Explaining({"direct", "tint"}, "tint").run();
    FAIL() << "NaN was averaged away";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("tint exact"), std::string::npos) << error.what();
  }
}

// Red if a stage of any method names a knob that its table lacks, a value out of range, or changes the paths
// that the reference is restricted to (make_explain_plan checks), under any preset.
TEST(Explain, StagesOfEveryMethodAreValidUnderEveryPreset) {
  const MethodList methods = make_all_methods();
  Explaining explaining({});
  for (const auto& method : methods) {
    explaining.options.method = method->name();
    std::vector<std::string> presets = {"paper"};
    for (const KnobPreset& preset : method->presets()) presets.push_back(preset.name);
    for (const std::string& preset : presets) {
      explaining.options.preset = preset;
      EXPECT_NO_THROW(make_explain_plan(explaining.options, methods)) << method->name() << " " << preset;
    }
  }
}

TEST(Explain, RefusesWhatItCannotDo) {
  const auto refused = [](void (*change)(ExplainOptions&)) {
    Explaining explaining({});
    change(explaining.options);
    try {
      make_explain_plan(explaining.options, explaining.methods);
    } catch (const UsageError&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.method = "plant"; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.pixels = 0; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.block = "6x4"; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.block = "4"; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.reference_samples = 1; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.preset = "worst"; }));
  EXPECT_TRUE(refused([](ExplainOptions& o) { o.settings = {"planted.dim=maybe"}; }));
}

}  // namespace
}  // namespace relight::test
