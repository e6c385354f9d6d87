// The decision itself on trial: renderers that are wrong must be caught, right ones must not.
#include <gtest/gtest.h>

#include "failure_report.h"
#include "stored_session.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

constexpr uint64_t seed = 77;

Decision decide(StoredSession& scene, const BatchPlan& plan) {
  return compare_pictures(scene.render(plan), scene.stored().picture);
}

// Red if: the tests are blind to gloss.
TEST(WrongRenderer, WithoutALobeIsCaught) {
  StoredSession scene("still_life_spot");
  BatchPlan plan = scene.few_samples(seed, 2);
  plan.paths.glossy_at_eye = false;
  EXPECT_FALSE(decide(scene, plan).same()) << "glossy lobe missing at the visible surface";
  plan = scene.few_samples(seed, 2);
  plan.paths.glossy_interior = false;
  EXPECT_FALSE(decide(scene, plan).same()) << "glossy lobe missing behind the visible surface";
}

// Red if: the tests are blind to a bounce; the last one carries least. Half the samples of the regression
// tests.
TEST(WrongRenderer, WithoutTheLastBounceIsCaught) {
  StoredSession scene("cornell_omni");
  BatchPlan plan = scene.few_samples(seed, 4);
  plan.paths.max_bounces -= 1;
  const Decision decision = decide(scene, plan);
  EXPECT_FALSE(decision.same()) << decision.to_string();
}

// Red if: the tests are blind to a bounce in the middle.
TEST(WrongRenderer, WithoutTheFirstBounceIsCaught) {
  StoredSession scene("hair_ball_spot");
  BatchPlan plan = scene.few_samples(seed, 1);
  plan.paths.min_bounces = 2;
  EXPECT_FALSE(decide(scene, plan).same());
}

// Red if: an error of brightness hides in the noise. (Every stored picture is tested so, in indirect light
// alone; here direct light is too bright as well, and what a person gets to see is checked.)
TEST(WrongRenderer, TwoPercentTooBrightIsCaughtAndReported) {
  StoredSession scene("cornell_spot");
  PictureStatistics fresh = brighter(scene.render(scene.few_samples(seed, 2)), 1.02);
  for (glm::vec3& p : fresh.direct.pixels) p *= 1.02f;
  const Decision decision = compare_pictures(fresh, scene.stored().picture);
  EXPECT_FALSE(decision.same());
  const TemporaryFolder folder;
  const std::string text =
      report_failure(folder.path(), "cornell_spot", fresh, scene.stored().picture, decision, 1.0f);
  EXPECT_NE(text.find("relight references update cornell_spot"), std::string::npos) << text;
  EXPECT_NE(text.find("DIFFERS"), std::string::npos) << text;
  for (const char* file : {"fresh.exr", "fresh.png", "reference.exr", "reference.png", "difference.exr",
                           "difference.png", "difference_in_sigmas.exr", "p_values.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
}

// Red if: tails, correlation of pixels or the uncertainty of variances make false alarms. With the level of
// 1e-4 twenty right renders pass with probability 0.998.
void expect_no_alarm(const std::string& name, int samples_per_batch) {
  StoredSession scene(name);
  for (uint64_t s = 100; s < 120; ++s) {
    const Decision decision = decide(scene, scene.few_samples(s, samples_per_batch));
    EXPECT_TRUE(decision.same()) << "seed " << s << "\n" << decision.to_string();
  }
}

TEST(RightRenderer, GivesNoAlarmWithTwentySeedsOnADiffuseScene) { expect_no_alarm("cornell_spot", 2); }

// Rare bright paths and a sample or two a pixel and batch: the hardest case for Student's distribution.
TEST(RightRenderer, GivesNoAlarmWithTwentySeedsOnAGlossyScene) { expect_no_alarm("still_life_spot", 1); }

}  // namespace
}  // namespace relight::test
