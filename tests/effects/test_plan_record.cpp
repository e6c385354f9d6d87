// The plan in the run record, its page, its table, and in experiments.
#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/run/run_record.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/method_list.h"
#include "experiments/report/report.h"
#include "experiments/run/record_of.h"
#include "experiments/run/run_experiment.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

EffectPlan full_plan() {
  EffectPlan plan;
  plan.tolerance = 0.02;
  plan.asked = {{"bounces", "2"}};
  EffectDecision d;
  d.effect = "bounces", d.sentence = "Bounces <of light>.", d.level = "2", d.everything = "8";
  d.by = DecidedBy::user, d.reason = "--effect", d.loss = {0.125, 0.12, 0.13};
  d.next_loss = LossInterval{0.25, 0.2, 0.3};
  d.undecided = true, d.settings = {{"bounces", "2"}}, d.measured = LossInterval{0.124, 0.123, 0.125};
  plan.effects = {d};
  plan.lights = {{"fill", "casts none"}};
  plan.everything = "all paths";
  plan.loss = {0.125, 0.12, 0.13};
  plan.beyond = LossInterval{0.5, 0.4, 0.6};
  plan.pilot_width = 160, plan.pilot_height = 120, plan.pilot_samples = 32, plan.pilot_rays = 12345;
  plan.seconds = 1.5, plan.warnings = {"careful"};
  EffectCheck check;
  check.measured = {0.124, 0.123, 0.125}, check.verdict = EffectVerdict::broken, check.as_predicted = true;
  check.samples = 64, check.seconds = 2.5;
  check.everything = EverythingRun{10, 5, 30, 20, 1000000, 500000, 0.0625};
  plan.check = check;
  return plan;
}

// Red if a field is written but not read, or under another's name.
TEST(PlanRecord, APlanSurvivesTheRecord) {
  RunRecord record;
  record.scene = "s", record.effect_plan = full_plan();
  const RunRecord back = record_from_json(record_to_json(record));
  ASSERT_TRUE(back.effect_plan);
  EXPECT_EQ(effect_plan_to_json(*back.effect_plan), effect_plan_to_json(full_plan()));
  EXPECT_EQ(back.effect_plan->effects[0].next_loss->high, 0.3);
  EXPECT_EQ(back.effect_plan->check->everything->planned_bytes, 500000);
  EXPECT_EQ(back.effect_plan->check->everything->planned_precompute_s, 5);
  record.effect_plan.reset();
  EXPECT_FALSE(record_from_json(record_to_json(record)).effect_plan);
}

TEST(PlanRecord, ABrokenPlanIsRefusedByItsField) {
  std::string text = effect_plan_to_json(full_plan());
  text.replace(text.find("\"broken\""), 8, "\"dunno\"");
  try {
    effect_plan_from_json(text);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'dunno' is none of kept, broken, open"), std::string::npos);
  }
}

TEST(PlanRecord, ThePageAndTheTextSayWhatWasLeftOutAndWhatItSaved) {
  const TemporaryFolder folder;
  RunRecord record;
  record.scene = "s", record.method = "m", record.effect_plan = full_plan();
  append_record(folder / "records.jsonl", record);
  write_report(folder.path());
  const std::string page = read_text(folder / "index.html");
  for (const char* words : {"What was not simulated and why", "Bounces &lt;of light&gt;.", "12.40&#8239;%",
                            "broken", "fill", "6.25&#8239;%", "500.0&#8239;kB"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  const std::string text = effect_plan_text(full_plan());
  for (const char* words :
       {"bounces=2", "12.4 [12.3, 12.5]", "broken", "as predicted", "5.00 s", "warning: careful"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

constexpr const char* experiment = R"(title = "Plans"
view = "20x15"
reference_samples = 16
repeats = 1
[[runs]]
scenes = ["cornell"]
lights = ["omni"]
method = "clustered_gather"
tolerance = TOLERANCES
[runs.effects]
soft_shadows = 4
[runs.knobs]
device = "cpu"
directions = 20
)";

// Red if a planned run is not recognised when the experiment goes on, or is taken for one of another
// tolerance.
TEST(PlanRecord, ExperimentsPlanAndGoOnWhereTheyStopped) {
  const TemporaryFolder folder;
  const MethodList methods = make_all_methods();
  const auto runs = [&](const std::string& tolerances) {
    std::string text = experiment;
    text.replace(text.find("TOLERANCES"), 10, tolerances);
    write_text(folder / "plans.toml", text);
    SessionOptions session;
    session.quiet = session.no_cache = true;
    return make_runs(read_experiment(folder / "plans.toml"), session, methods, folder / "out");
  };
  const RunList two = runs("[0.01, \"90%\"]");
  ASSERT_EQ(two.runs.size(), 2u);
  EXPECT_NE(describe(two.runs[0]).find("tolerance=0.01"), std::string::npos);
  const ExperimentResult result = run_experiment(two, folder / "out", false);
  ASSERT_TRUE(result.failures.empty()) << result.failures.front();
  ASSERT_TRUE(result.records[0].effect_plan);
  EXPECT_EQ(result.records[0].knobs.at("bounces"), "1");
  EXPECT_EQ(result.records[1].knobs.at("bounces"), "0");
  EXPECT_EQ(result.records[0].knobs.at("area_light_samples"), "4");
  for (size_t i : {0u, 1u})
    for (size_t j : {0u, 1u}) EXPECT_EQ(is_record_of(result.records[i], two.runs[j]), i == j) << i << j;
  EXPECT_FALSE(is_record_of(result.records[0], runs("0.02").runs[0]));
  const std::string table = read_text(folder / "out/table.csv");
  EXPECT_NE(table.find("left_out_measured_percent"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
