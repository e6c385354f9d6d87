// What the plan leaves out costs nothing, shown by counters and bytes, and the picture is the same within the
// tolerance; what it wrongly leaves out is caught.
#include <gtest/gtest.h>

#include "experiments/compare/compare.h"
#include "experiments/method_list.h"
#include "plan_cases.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

struct Case {
  std::string scene, lights;
  std::vector<std::string> effects = {};
  bool check = true;
  std::vector<std::string> settings = {};
};

// One run of each method that gathers, on the CPU unless `device` says otherwise.
std::vector<RunRecord> run(const Case& c, const std::string& device = "cpu",
                           const std::string& methods = "direct_to_indirect,clustered_gather") {
  const TemporaryFolder folder;
  const MethodList all = make_all_methods();
  CompareOptions options;
  options.session = session_options(c.scene, c.lights, "40x30");
  options.methods = methods;
  for (const std::string& method : parse_name_list("methods", methods))
    options.settings.push_back(method + ".device=" + device);
  if (methods.find("direct_to_indirect") != std::string::npos)
    for (const char* knob : {"gather_samples=1024", "photons=20000", "photon_neighbours=50"})
      options.settings.push_back(std::string("direct_to_indirect.") + knob);
  if (methods.find("clustered_gather") != std::string::npos)
    for (const char* knob : {"directions=100", "gather_clusters=20", "view_clusters=400"})
      options.settings.push_back(std::string("clustered_gather.") + knob);
  options.settings.insert(options.settings.end(), c.settings.begin(), c.settings.end());
  options.effects = {"1%", c.effects, c.check};
  options.reference_samples = 64;
  options.repeats = 1;
  options.out = folder / "out";
  return compare(make_plan(options, all));
}

int64_t counter(const RunRecord& r, const std::string& name) {
  const auto found = r.counters.find(name);
  return found == r.counters.end() ? 0 : found->second;
}

int64_t bytes(const RunRecord& r, const std::string& name) {
  const auto found = r.memory_bytes.find(name);
  return found == r.memory_bytes.end() ? 0 : found->second;
}

void expect_good(const RunRecord& r) {
  EXPECT_TRUE(r.failed_stages.empty()) << r.method << ": " << r.failed_stages.front();
  ASSERT_TRUE(r.effect_plan && r.effect_plan->check) << r.method;
}

void expect_no_indirect_work(const RunRecord& r) {
  for (const char* name : {"visibility_rays", "links", "non_zeros", "photons", "photon_rays",
                           "bounce_non_zeros", "glossy_pixels", "glossy_rays", "gather_rays",
                           "glossy_gather_rays", "gather_samples", "view_clusters"})
    EXPECT_EQ(counter(r, name), 0) << r.method << " " << name;
  for (const char* name :
       {"final_gather_matrix", "glossy_matrix", "multi_bounce_matrix", "links", "gather_samples"})
    EXPECT_EQ(bytes(r, name), 0) << r.method << " " << name;
}

// Red if no bounces still precompute something (tried: without the branch to direct light alone the method
// fails or gathers).
TEST(EffectCounters, WithDirectLightAloneNothingIsGathered) {
  for (const char* scene : {"plane", "cube"})
    for (const RunRecord& r : run({scene, "omni"})) {
      expect_good(r);
      EXPECT_EQ(r.knobs.at("bounces"), "0");
      expect_no_indirect_work(r);
      EXPECT_GT(counter(r, "shadow_rays"), 0);
      const EffectCheck& check = *r.effect_plan->check;
      EXPECT_EQ(check.verdict, EffectVerdict::kept);
      EXPECT_EQ(check.measured.high, 0.0);
      ASSERT_TRUE(check.everything);
      EXPECT_LT(check.everything->picture_change, 1e-6);
      EXPECT_LT(check.everything->planned_bytes, check.everything->bytes);
      EXPECT_LT(r.errors->value.relative, 1e-4);  // direct light with traced shadows is exact
    }
}

TEST(EffectCounters, OnTheGpuToo) {
  for (const RunRecord& r : run({"plane", "omni"}, "gpu")) {
    expect_good(r);
    expect_no_indirect_work(r);
    EXPECT_EQ(counter(r, "shadow_maps_rendered"), 6);
    EXPECT_LT(r.effect_plan->check->everything->picture_change, 1e-6);
    EXPECT_LT(r.errors->value.relative, 1e-3);
  }
}

// One bounce by --set: with more of them direct_to_indirect's gather samples would be others, and the picture
// with them.
TEST(EffectCounters, WithoutVisibleGlossThereIsNoGlossyMatrixAndThePictureIsTheSame) {
  const std::vector<std::string> one = {"direct_to_indirect.bounces=1", "clustered_gather.bounces=1"};
  for (const RunRecord& r : run({"hidden_gloss", "spot", {}, true, one})) {
    expect_good(r);
    EXPECT_EQ(r.knobs.at("glossy"), "off");
    for (const char* name : {"glossy_pixels", "glossy_non_zeros", "glossy_rays", "glossy_gather_rays",
                             "glossy_view_clusters", "glossy_transfer_blocks"})
      EXPECT_EQ(counter(r, name), 0) << r.method << " " << name;
    EXPECT_EQ(bytes(r, "glossy_matrix"), 0);
    EXPECT_EQ(r.effect_plan->check->verdict, EffectVerdict::kept);
    EXPECT_EQ(r.effect_plan->check->everything->picture_change, 0.0) << r.method;
  }
}

TEST(EffectCounters, BouncesBelowTheToleranceShootNoPhotons) {
  // One bounce of a room that reflects a hundredth: the second is a ten-thousandth.
  const RunRecord r = run({"dark_room", "omni"}, "cpu", "direct_to_indirect").front();
  expect_good(r);
  EXPECT_LE(std::stoi(r.knobs.at("bounces")), 1);
  for (const char* name : {"photons", "photon_rays", "bounce_non_zeros"})
    EXPECT_EQ(counter(r, name), 0) << name;
  EXPECT_EQ(bytes(r, "multi_bounce_matrix"), 0);
  EXPECT_EQ(r.effect_plan->check->verdict, EffectVerdict::kept);
}

// "No shadow map for lights that cast none".
TEST(EffectCounters, ALampThatCastsNoShadowsGetsNoShadowMapAndThePlanSaysSo) {
  for (const std::string device : {"cpu", "gpu"})
    for (const RunRecord& r : run({"plane", "unshadowed", {}, false}, device)) {
      expect_good(r);
      EXPECT_EQ(counter(r, "shadow_maps_rendered"), 0) << r.method;
      EXPECT_EQ(counter(r, "shadow_rays"), 0) << r.method;
      ASSERT_EQ(r.effect_plan->lights.size(), 1u);
      EXPECT_EQ(r.effect_plan->lights[0].light, "fill");
    }
}

// A planted wrong decision: one bounce where many are needed. Red if the check measures what the plan says in
// place of what it lost (tried: everything's levels taken from the plan).
TEST(EffectCounters, ABounceLeftOutByForceIsCaughtByTheCheck) {
  for (const RunRecord& r : run({"bright_box", "omni", {"bounces=1"}, false})) {
    expect_good(r);
    const bool one_is_all = r.method == "clustered_gather";
    EXPECT_EQ(r.effect_plan->check->verdict, one_is_all ? EffectVerdict::kept : EffectVerdict::broken)
        << r.method;
    bool warned = false;
    for (const std::string& w : r.warnings)
      warned = warned || w.find("more than the tolerance") != std::string::npos;
    EXPECT_EQ(warned, !one_is_all);
  }
}

TEST(EffectCounters, GlossLeftOutByForceIsCaughtByTheCheck) {
  for (const RunRecord& r : run({"visible_gloss", "spot", {"glossy_final_gather=off"}, false})) {
    expect_good(r);
    EXPECT_EQ(r.knobs.at("glossy"), "off");
    EXPECT_EQ(r.effect_plan->check->verdict, EffectVerdict::broken) << r.method;
    EXPECT_TRUE(r.effect_plan->check->as_predicted) << r.method;
  }
}

TEST(EffectCounters, WithoutAToleranceNothingIsPlanned) {
  const TemporaryFolder folder;
  const MethodList all = make_all_methods();
  CompareOptions options;
  options.session = session_options("plane", "omni", "16x12");
  options.methods = "clustered_gather";
  options.settings = {"clustered_gather.device=cpu"};
  options.reference_samples = 16;
  options.out = folder / "out";
  const RunRecord r = compare(make_plan(options, all)).front();
  EXPECT_FALSE(r.effect_plan);
  EXPECT_EQ(r.knobs.at("bounces"), "1");
}

}  // namespace
}  // namespace relight::test
