// The whole of `relight tune` on a method whose error and memory are known: choice, verification, resuming.
#include <gtest/gtest.h>

#include <set>

#include <nlohmann/json.hpp>

#include "experiments/tune/tune.h"
#include "experiments/tune/verify_lights.h"
#include "experiments/usage_error.h"
#include "scaled_method.h"
#include "tests/cli/program.h"

namespace relight {
namespace {

using test::TemporaryFolder;

struct Trial {
  TemporaryFolder folder;
  int relights = 0;
  MethodList methods;
  TuneOptions options;

  explicit Trial(bool overfit = false) {
    methods.push_back(test::make_scaled_method(relights, overfit));
    options.session.scene = "cornell", options.session.lights = "omni", options.session.view = "16x12";
    options.session.quiet = true, options.session.no_cache = true;
    options.error = "9%", options.metric = "indirect", options.minimise = "memory",
    options.verify_lights = "near,spot";
    options.reference_samples = 256, options.repeats = 1, options.out = folder / "out";
  }
  TuneResult run() { return tune(make_tune_plan(options, methods)); }
};

// Least quality + 3 detail with 0.4 / quality + 0.2 / detail below 0.09: (16, 4). From the defaults (8, 8) no
// single step leads there.
TEST(TuneRunner, FindsTheKnownOptimumAndVerifiesItUnderOtherLights) {
  Trial trial;
  const TunePlan plan = make_tune_plan(trial.options, trial.methods);
  const TuneResult result = tune(plan);
  ASSERT_NE(result.chosen, SIZE_MAX);
  EXPECT_TRUE(result.keeps_bounds);
  const TuneResult::Line& chosen = result.tried[result.chosen];
  EXPECT_EQ(chosen.changed, (std::map<std::string, std::string>{{"quality", "16"}, {"detail", "4"}}));
  EXPECT_NEAR(chosen.outcome.memory_mb, 28.0, 1e-9);
  EXPECT_NEAR(chosen.outcome.error, 0.075, 0.01);
  EXPECT_NE(chosen.command.find("--set scaled.quality=16"), std::string::npos);
  EXPECT_TRUE(result.unfinished.empty());
  ASSERT_EQ(result.verified.size(), 2u);
  EXPECT_TRUE(result.all_met());
  const std::string text = tune_text(plan, result);
  EXPECT_NE(text.find("met on 2 of 2"), std::string::npos) << text;
  EXPECT_NE(text.find(chosen.command), std::string::npos);
}

// A method that is right under the searched lights only. Red if verification looks at the search's lights
// again.
TEST(TuneRunner, ASettingThatIsRightOnlyUnderTheSearchedLightsIsToldSo) {
  Trial trial(true);
  const TuneResult result = trial.run();
  EXPECT_TRUE(result.keeps_bounds);
  ASSERT_EQ(result.verified.size(), 2u);
  EXPECT_EQ(result.met(), 0);
  for (const Verification& v : result.verified) {
    EXPECT_EQ(v.verdict, BoundVerdict::not_met);
    EXPECT_GT(v.outcome.error, 0.4);
  }
  EXPECT_NE(tune_text(make_tune_plan(trial.options, trial.methods), result).find("met on 0 of 2"),
            std::string::npos);
}

// Red if a second search measures again what the first one left, or goes another way.
TEST(TuneRunner, GoesOnFromItsRecords) {
  Trial trial;
  trial.options.runs = 3;
  const TuneResult cut = trial.run();
  EXPECT_EQ(cut.tried.size(), 3u);
  EXPECT_EQ(cut.unfinished.size(), 1u);
  const int before = trial.relights;
  trial.options.runs = 60;
  const TuneResult resumed = trial.run();
  const int resumed_relights = trial.relights - before;
  Trial whole;
  const TuneResult afresh = whole.run();
  EXPECT_LT(resumed_relights, whole.relights);
  ASSERT_EQ(resumed.tried.size(), afresh.tried.size());
  EXPECT_EQ(resumed.tried[resumed.chosen].changed, afresh.tried[afresh.chosen].changed);
  const int after = trial.relights;
  trial.run();
  EXPECT_EQ(trial.relights, after);
}

TEST(TuneRunner, SaysTheClosestAndWhatItBreaks) {
  Trial trial;
  trial.options.error = "2%", trial.options.memory_mb = 20;
  const TunePlan plan = make_tune_plan(trial.options, trial.methods);
  const TuneResult result = tune(plan);
  EXPECT_FALSE(result.keeps_bounds);
  const std::string text = tune_text(plan, result);
  EXPECT_NE(text.find("No setting that was tried keeps all bounds. The closest"), std::string::npos);
  EXPECT_NE(text.find("which breaks: "), std::string::npos);
  const auto json = nlohmann::json::parse(tune_json(plan, result));
  EXPECT_FALSE(json["keeps_bounds"]);
  EXPECT_EQ(json["tried"].size(), result.tried.size());
  EXPECT_FALSE(json["tried"][result.chosen]["breaks"].empty());
}

TEST(TuneRunner, RefusesWrongOptionsBeforeAnythingStarts) {
  const auto refused = [](auto change) {
    Trial trial;
    change(trial.options);
    EXPECT_THROW(make_tune_plan(trial.options, trial.methods), UsageError);
    EXPECT_EQ(trial.relights, 0);
  };
  refused([](TuneOptions& o) { o.error = "0"; });
  refused([](TuneOptions& o) { o.error = "five"; });
  refused([](TuneOptions& o) { o.minimise = "time"; });
  refused([](TuneOptions& o) { o.metric = "ssim"; });
  refused([](TuneOptions& o) { o.methods = {"nobody"}; });
  refused([](TuneOptions& o) { o.methods = {"scaled", "scaled"}; });
  refused([](TuneOptions& o) { o.settings = {"scaled.size=3"}; });
  refused([](TuneOptions& o) { o.relight_ms = -1; });
  refused([](TuneOptions& o) { o.runs = 0; });
  Trial trial;
  trial.options.verify_lights = "no_such_preset";
  EXPECT_THROW(trial.run(), UsageError);
  EXPECT_EQ(trial.relights, 0);
}

TEST(TuneVerdict, IsOpenWhereTheIntervalHoldsTheBound) {
  Outcome o;
  o.error = 0.05, o.half_width = 0.002;
  EXPECT_EQ(error_verdict(o, 0.06), BoundVerdict::met);
  EXPECT_EQ(error_verdict(o, 0.051), BoundVerdict::open);
  EXPECT_EQ(error_verdict(o, 0.049), BoundVerdict::open);
  EXPECT_EQ(error_verdict(o, 0.04), BoundVerdict::not_met);
  o.failure = "failed";
  EXPECT_EQ(error_verdict(o, 0.06), BoundVerdict::not_met);
}

// Red if a lamp hangs in a wall, or two lamps are alike.
TEST(VerifyLamps, HangWhereTheViewIsLitAndDiffer) {
  TemporaryFolder folder;
  SessionOptions options;
  options.scene = "cornell", options.lights = "omni", options.view = "16x12", options.quiet = true;
  const Session session(options, Session::Gpu::not_needed);
  std::set<std::string> texts;
  for (uint64_t number = 0; number < 6; ++number) {
    const std::string text =
        lamp_file_text(session.scene(), session.tracer(), session.buffer(), session.lighting(), 1, number);
    EXPECT_TRUE(texts.insert(text).second);
    EXPECT_EQ(text, lamp_file_text(session.scene(), session.tracer(), session.buffer(), session.lighting(), 1,
                                   number));
    test::write_text(folder / "lamp.toml", text);
    const LightingState lamp = load_named_lighting(session.scene(), folder / "lamp.toml");
    ASSERT_EQ(lamp.lights.size(), 1u);
    int lit = 0;
    for (const SurfaceSample& s : session.buffer().indirect)
      lit += s.valid &&
             session.tracer().visible_from_point(s.position, s.geometric_normal, lamp.lights[0].position);
    EXPECT_GT(lit, 20) << text;
  }
}

}  // namespace
}  // namespace relight
