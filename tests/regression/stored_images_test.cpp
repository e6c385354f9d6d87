// The path tracer against every stored reference, by hypothesis tests.
#include <set>

#include <gtest/gtest.h>

#include "failure_report.h"
#include "stored_session.h"

namespace relight::test {
namespace {

constexpr uint64_t fresh_seed = 1;

class StoredImage : public testing::TestWithParam<std::string> {};

// Error of brightness of the indirect light, from 0 to 16 %, from which on it is caught, to 0.05 %, by
// bisection.
double smallest_caught_error(const PictureStatistics& fresh, const PictureStatistics& stored, double sign) {
  double missed = 0.0, caught = 0.16;
  while (caught - missed > 0.0005) {
    const double error = 0.5 * (missed + caught);
    (compare_pictures(brighter(fresh, 1.0 + sign * error), stored).same() ? missed : caught) = error;
  }
  return caught;
}

// What the test of a picture must at least catch (docs/references.md has the measured values). still_life has
// gloss that is found by chance; the light of `near` almost touches a wall, and paths that end there have a
// variance without bound.
double required_sharpness(const std::string& name) {
  if (name == "cornell_near") return 0.07;
  return name.starts_with("still_life") ? 0.03 : 0.02;
}

// Four times as many for the picture whose noise hides most.
int fresh_samples(const std::string& name) { return name == "cornell_near" ? 16 : 4; }

// Red if: the path tracer's expectation changes anywhere, in a scene, a light or a bounce; or the scene,
// lights, camera or settings are no longer those of the stored picture. And the test must be sharp: the same
// picture 2 % brighter or darker in its indirect light alone is not the same.
TEST_P(StoredImage, AgreesWithThePathTracerAndNotWithOneABitBrighterOrDarker) {
  StoredSession scene(GetParam());
  const auto stale =
      stale_fields(scene.stored().identity, picture_identity(scene.reference(), scene.session()));
  ASSERT_TRUE(stale.empty()) << "STALE: " << testing::PrintToString(stale)
                             << "\nrender it anew: relight references update " << GetParam();
  const PictureStatistics fresh = scene.render(scene.few_samples(fresh_seed, fresh_samples(GetParam())));
  const PictureStatistics& stored = scene.stored().picture;
  const Decision decision = compare_pictures(fresh, stored);
  EXPECT_TRUE(decision.same()) << report_failure(failures_folder() / GetParam(), GetParam(), fresh, stored,
                                                 decision, scene.session().scene().exposure);
  const double above = smallest_caught_error(fresh, stored, 1.0),
               below = smallest_caught_error(fresh, stored, -1.0);
  EXPECT_LE(above, required_sharpness(GetParam()));
  EXPECT_LE(below, required_sharpness(GetParam()));
  std::printf("%s: caught from +%.2f %% and -%.2f %% on\n", GetParam().c_str(), 100.0 * above, 100.0 * below);
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const StoredReference& reference : stored_references()) list.push_back(reference.name);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, StoredImage, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

// Red if: a listed picture is missing (its test would fail too) or a folder is there that no test reads.
TEST(StoredImages, FoldersAreThoseOfTheList) {
  std::set<std::string> folders;
  for (const auto& entry : std::filesystem::directory_iterator(images_folder()))
    folders.insert(entry.path().filename().string());
  const auto listed = names();
  EXPECT_EQ(folders, std::set<std::string>(listed.begin(), listed.end()));
}

// Red if: samples that were not finite were stored.
TEST(StoredImages, HoldNoReplacedSamples) {
  for (const std::string& name : names()) {
    const StoredPicture stored = load_stored(images_folder() / name);
    EXPECT_EQ(stored.picture.non_finite, 0) << name;
  }
}

// Red if: the two estimators disagree; next_event is the simpler one.
TEST(StoredImages, AgreeWithNextEventEstimation) {
  StoredSession scene("cornell_omni");
  BatchPlan plan = scene.few_samples(fresh_seed, 8);
  plan.estimator = Estimator::next_event;
  const Decision decision = compare_pictures(scene.render(plan), scene.stored().picture);
  EXPECT_TRUE(decision.same()) << decision.to_string();
}

}  // namespace
}  // namespace relight::test
