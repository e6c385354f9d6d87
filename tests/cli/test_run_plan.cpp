// `relight run --dry-run`: the order of runs, and estimates from earlier records.
#include <gtest/gtest.h>

#include "experiments/run/forecast.h"
#include "program.h"

namespace relight::test {
namespace {

RunList list_of(const std::string& knobs, const MethodList& methods, const TemporaryFolder& folder) {
  write_text(folder / "plan.toml",
             "title = 'plan'\nview = '64x48'\nreference_samples = 16\nrepeats = 2\n[[runs]]\n"
             "scenes = ['cornell']\nlights = ['spot', 'omni']\nmethod = 'direct_to_indirect'\n"
             "[runs.knobs]\n" +
                 knobs);
  SessionOptions session;
  return make_runs(read_experiment(folder / "plan.toml"), session, methods, folder / "out");
}

// Red if a relight knob that stands before a precompute knob in the alphabet (coefficients of the sweep, then
// device) tears runs with the same data apart, or lights mix.
TEST(RunPlan, RunsThatShareDataFollowEachOther) {
  TemporaryFolder folder;
  const MethodList methods = make_all_methods();
  const RunList list = list_of("cull_epsilon = [-1, 0]\ngather_samples = [1024, 2048]\n", methods, folder);
  std::vector<std::string> keys;
  for (const PlannedRun& run : list.runs) {
    const std::string key = run.plan.session.lights + run.plan.methods.front().knobs.precompute_key();
    if (keys.empty() || keys.back() != key) keys.push_back(key);
  }
  ASSERT_EQ(list.runs.size(), 8u);
  EXPECT_EQ(keys.size(), 4u) << "two lights, two sets of data each";
  EXPECT_EQ(list.runs.front().plan.session.lights, "omni");
}

// A record of the run, made up.
RunRecord record_of(const PlannedRun& run, const Provenance& here) {
  RunRecord r;
  r.scene = run.plan.session.scene, r.view = "32x24", r.method = "direct_to_indirect";
  r.scene_hash = run.scene_hash;
  r.knobs = run.plan.methods.front().knobs.all();
  r.precompute_s = 10.0, r.relight_ms = {500.0, 400.0, 600.0, 5};
  r.memory_bytes = {{"matrix", 1000}, {"process_peak", 77}};
  r.reference = ReferenceCost{32, 8, 8.0, 1, "light_vertex", false};
  r.provenance = here;
  return r;
}

// Red if pixels or samples are not scaled by, warm-ups are forgotten, or shared data are counted twice.
TEST(RunPlan, EstimatesScaleByPixelsAndCountSharedWorkOnce) {
  TemporaryFolder folder;
  const MethodList methods = make_all_methods();
  const RunList list = list_of("cull_epsilon = [-1, 0]\n", methods, folder);
  Provenance here;
  here.cpu = "CPU", here.threads = 2, here.build_type = "Release";
  const Forecasts forecasts({record_of(list.runs[0], here)}, here);
  const std::vector<bool> none(list.runs.size(), false);
  const auto each = forecasts.of(list.runs, none);
  ASSERT_EQ(each.size(), 4u);
  ASSERT_TRUE(each[0] && each[1] && each[2]);
  EXPECT_DOUBLE_EQ(each[0]->precompute_s, 40.0) << "four times the pixels";
  EXPECT_DOUBLE_EQ(each[1]->precompute_s, 0.0) << "the same data";
  EXPECT_DOUBLE_EQ(each[0]->relights_s, 4.0 * 0.5 * (1 + 2 + 2))
      << "to warm up, timed, and one before each turn";
  EXPECT_DOUBLE_EQ(each[0]->reference_s, 16.0) << "four times the pixels, half the samples";
  EXPECT_DOUBLE_EQ(each[1]->reference_s, 0.0) << "the same reference";
  EXPECT_DOUBLE_EQ(each[2]->reference_s, 16.0) << "another lighting";
  EXPECT_EQ(each[0]->bytes, 4000);
  EXPECT_EQ(each[0]->basis, "same scene and settings");
  EXPECT_EQ(each[1]->basis, "same scene, other settings");
  EXPECT_DOUBLE_EQ(*seconds_in_all(each, none), 40.0 + 4 * 10.0 + 2 * 16.0);
  EXPECT_NE(plan_text(list.runs, none, forecasts).find("time in all: about 1 min 52 s"), std::string::npos)
      << plan_text(list.runs, none, forecasts);
}

// Red if another machine's times are taken for this one's, or nothing known passes for no time.
TEST(RunPlan, WithoutRecordsOfThisMachineNothingIsKnown) {
  TemporaryFolder folder;
  const MethodList methods = make_all_methods();
  const RunList list = list_of("cull_epsilon = [-1, 0]\n", methods, folder);
  Provenance here, elsewhere;
  here.cpu = "CPU A", elsewhere.cpu = "CPU B";
  RunRecord shared = record_of(list.runs[0], here), failed = shared;
  shared.provenance.shared_machine = true;
  failed.failed_stages = {"relight: broken"};
  const Forecasts forecasts({record_of(list.runs[0], elsewhere), shared, failed}, here);
  const std::vector<bool> none(list.runs.size(), false);
  EXPECT_EQ(forecasts.records(), 0u);
  EXPECT_FALSE(forecasts.of(list.runs, none)[0]);
  EXPECT_NE(plan_text(list.runs, none, forecasts).find("time in all: unknown"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
