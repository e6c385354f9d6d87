// The plan on scenes made for it: exactly what each calls for.
#include <gtest/gtest.h>

#include "experiments/method_list.h"
#include "experiments/usage_error.h"
#include "plan_cases.h"
#include "planted_effects.h"

namespace relight::test {
namespace {

constexpr const char* transfer = "direct_to_indirect";

TEST(Planner, WithoutGlossyMaterialsARuleLeavesTheGlossyMatrixOut) {
  for (const char* method : {transfer, "clustered_gather"}) {
    const EffectPlan plan = plan_of({"cornell", "omni", method});
    const EffectDecision& gloss = decision(plan, "glossy_final_gather");
    EXPECT_EQ(gloss.level, "off");
    EXPECT_EQ(gloss.by, DecidedBy::rule);
    EXPECT_NE(gloss.reason.find("no material is glossy"), std::string::npos) << gloss.reason;
    EXPECT_EQ(gloss.loss.high, 0.0);
    EXPECT_EQ(decision(plan, "soft_shadows").level, "1");
    EXPECT_EQ(decision(plan, "soft_shadows").by, DecidedBy::rule);
  }
}

// Red if the rule looks at the scene's materials in place of the view (tried: glossy_pixels = 1 wherever a
// material is: decided by the pilot, not the rule), or at the view alone where the wall is seen.
TEST(Planner, GlossOutOfViewIsLeftOutByARuleAndInViewIsKept) {
  const EffectPlan hidden = plan_of({"hidden_gloss", "spot", transfer});
  EXPECT_EQ(decision(hidden, "glossy_final_gather").level, "off");
  EXPECT_EQ(decision(hidden, "glossy_final_gather").by, DecidedBy::rule);
  EXPECT_NE(decision(hidden, "glossy_final_gather").reason.find("no visible"), std::string::npos);
  const EffectPlan seen = plan_of({"visible_gloss", "spot", transfer});
  EXPECT_EQ(decision(seen, "glossy_final_gather").level, "on");
  EXPECT_EQ(decision(seen, "glossy_final_gather").by, DecidedBy::pilot);
  EXPECT_GT(decision(seen, "glossy_final_gather").next_loss->low, 0.01);
}

// Red without the rule of one plane (tried: without it; the pilot should say the same, but it runs).
TEST(Planner, OnOnePlaneARuleLeavesDirectLightAndNoPilotRuns) {
  for (const char* method : {transfer, "clustered_gather", "path_tracing"}) {
    const EffectPlan plan = plan_of({"plane", "omni", method});
    EXPECT_EQ(decision(plan, "bounces").level, "0");
    EXPECT_EQ(decision(plan, "bounces").by, DecidedBy::rule);
    EXPECT_EQ(plan.pilot_samples, 0) << method;
    EXPECT_EQ(plan.loss.high, 0.0);
  }
}

TEST(Planner, OnAConvexObjectThePilotLeavesDirectLight) {
  const EffectPlan plan = plan_of({"cube", "omni", transfer});
  EXPECT_EQ(decision(plan, "bounces").level, "0");
  EXPECT_EQ(decision(plan, "bounces").by, DecidedBy::pilot);
  EXPECT_EQ(plan.loss.high, 0.0);
  EXPECT_GT(plan.pilot_samples, 0);
}

// Albedo 0.95: each bounce is 0.95 of the one before, so all 8 are needed, and even these leave out 0.95^9 =
// 63 % of the light. The walls' corners are darker than a sphere's, so the share is a little less.
TEST(Planner, InABrightClosedRoomAllBouncesAreComputedAndTheRestIsTold) {
  const EffectPlan plan = plan_of({"bright_box", "omni", transfer});
  EXPECT_EQ(decision(plan, "bounces").level, "8");
  ASSERT_TRUE(plan.beyond);
  EXPECT_GT(plan.beyond->low, 0.5);
  EXPECT_LT(plan.beyond->high, 0.7);
}

// Bounces of a sphere of albedo 0.5 against the geometric series: the least n for which bounces n + 1 to 8
// are below the tolerance. Red if the rest is compared with the picture of the bounces kept, or if a bounce
// is counted with its neighbour.
TEST(Planner, TheNumberOfBouncesIsThatOfTheGeometricSeries) {
  const MethodList methods = make_all_methods();
  const Method& method = find_method(methods, transfer);
  const KnobValues knobs(method.knobs());
  const tiny::Rendering sphere = lit_sphere(0.5f, 24, 18);
  const LightingState lighting = lamp_in_the_centre();
  const EffectSite site{sphere.scene, sphere.tracer, sphere.buffer, lighting};
  Progress quiet(true);
  for (const double tolerance : {0.4, 0.2, 0.1, 0.05, 0.01, 0.004}) {
    int expected = 8;
    while (expected > 0 && share_of_bounces(0.5, expected, 8) <= tolerance) --expected;
    const EffectPlan plan = plan_effects({method, knobs, {}, tolerance, {}, 3}, site, quiet);
    EXPECT_EQ(decision(plan, "bounces").level, std::to_string(expected)) << tolerance;
  }
}

TEST(Planner, EnvironmentSamplesAreTakenOnlyWhereThereIsAnEnvironment) {
  const EffectPlan without = plan_of({"cornell", "omni", "path_tracing"});
  EXPECT_EQ(decision(without, "environment").level, "off");
  EXPECT_EQ(decision(without, "environment").by, DecidedBy::rule);
  EXPECT_EQ(decision(without, "emission").level, "off");
  EXPECT_EQ(decision(without, "emission").by, DecidedBy::rule);
  const EffectPlan with = plan_of({"sky", "omni", "path_tracing"});
  EXPECT_EQ(decision(with, "environment").level, "on");
  EXPECT_EQ(decision(with, "environment").by, DecidedBy::pilot);
  // Every method that can leave it out.
  for (const char* method : {"direct_to_indirect", "clustered_gather"}) {
    EXPECT_EQ(decision(plan_of({"cornell", "omni", method}), "environment").level, "off");
    EXPECT_EQ(decision(plan_of({"sky", "omni", method}), "environment").level, "on");
  }
}

TEST(Planner, SoftShadowsAreComputedWhereALightHasAnArea) {
  const EffectPlan plan = plan_of({"plane", "area", transfer});
  EXPECT_EQ(decision(plan, "soft_shadows").by, DecidedBy::pilot);
  // An open plane has no shadows, but one point is not an area: its light falls off otherwise.
  EXPECT_NE(decision(plan, "soft_shadows").level, "1");
  EXPECT_EQ(decision(plan_of({"plane", "area", transfer, {}, {}, 0.3}), "soft_shadows").level, "1");
}

// Losses of effects that are left out together are held against the tolerance together. Red if each effect
// has the tolerance to itself (tried: base replaced by the effect's own last level).
TEST(Planner, TheWholePlanStaysWithinTheTolerance) {
  const auto method = make_planted_method();
  const KnobValues knobs(method->knobs());
  const tiny::Rendering sphere = lit_sphere(0.5f, 24, 18);
  const LightingState lighting = lamp_in_the_centre();
  const EffectSite site{sphere.scene, sphere.tracer, sphere.buffer, lighting};
  Progress quiet(true);
  // Of all light up to 3 bounces, direct light is 8/15, the third bounce 1/15 = 6.7 %, a term 0.53 %.
  const auto levels = [&](double tolerance) {
    const EffectPlan plan = plan_effects({*method, knobs, {}, tolerance, {}, 3}, site, quiet);
    EXPECT_LE(plan.loss.high, tolerance);
    return decision(plan, "bounces").level + "," + decision(plan, "terms").level;
  };
  EXPECT_EQ(levels(0.004), "3,4");
  EXPECT_EQ(levels(0.006), "3,3");
  EXPECT_EQ(levels(0.012), "3,2");
  EXPECT_EQ(levels(0.069), "3,1");  // the bounce alone would fit, but not on top of the terms
  EXPECT_EQ(levels(0.09), "2,1");
}

TEST(Planner, AnEffectOfAMethodsOwnKindIsRuledByTheMethodsOwnWords) {
  const auto method = make_planted_method();
  const KnobValues knobs(method->knobs());
  tiny::Rendering sphere = lit_sphere(0.5f, 24, 18);
  sphere.scene.name = "plain";
  const LightingState lighting = lamp_in_the_centre();
  Progress quiet(true);
  const EffectPlan plan = plan_effects({*method, knobs, {}, 0.0, {}, 3},
                                       {sphere.scene, sphere.tracer, sphere.buffer, lighting}, quiet);
  EXPECT_EQ(decision(plan, "terms").level, "1");
  EXPECT_EQ(decision(plan, "terms").reason, "the scene is plain");
  EXPECT_EQ(decision(plan, "bounces").level, "3");
}

TEST(Planner, TheUsersWordWinsAndIsSaid) {
  const EffectPlan asked = plan_of({"cornell", "omni", transfer, {}, {{"bounces", "1"}}});
  EXPECT_EQ(decision(asked, "bounces").level, "1");
  EXPECT_EQ(decision(asked, "bounces").by, DecidedBy::user);
  EXPECT_GT(decision(asked, "bounces").loss.low, 0.01);  // what that costs is told
  EXPECT_GT(asked.loss.low, 0.01);
  const EffectPlan set = plan_of({"cornell", "omni", transfer, {"bounces=3"}});
  EXPECT_EQ(decision(set, "bounces").level, "bounces=3");
  EXPECT_EQ(decision(set, "bounces").by, DecidedBy::user);
  EXPECT_NE(decision(set, "bounces").reason.find("--set direct_to_indirect.bounces"), std::string::npos);
  EXPECT_TRUE(decision(set, "bounces").settings.empty());
  EXPECT_THROW(plan_of({"cornell", "omni", transfer, {"bounces=3"}, {{"bounces", "1"}}}), UsageError);
  EXPECT_THROW(plan_of({"cornell", "omni", transfer, {}, {{"bounces", "99"}}}), UsageError);
}

// Red if a sum is made in the order in which threads finish.
TEST(Planner, TheSameSeedGivesTheSamePlanForAnyNumberOfThreads) {
  PlanCase c{"visible_gloss", "omni", transfer};
  c.threads = 1;
  EffectPlan one = plan_of(c);
  c.threads = 3;
  EffectPlan three = plan_of(c);
  one.seconds = three.seconds = 0.0;
  EXPECT_EQ(effect_plan_to_json(one), effect_plan_to_json(three));
  c.seed = 2;
  EffectPlan other = plan_of(c);
  other.seconds = 0.0;
  EXPECT_NE(effect_plan_to_json(one), effect_plan_to_json(other));
}

}  // namespace
}  // namespace relight::test
