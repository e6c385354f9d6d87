// Which classes a choice of levels carries.
#include <set>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "experiments/effects/effect_paths.h"
#include "planted_effects.h"

namespace relight::test {
namespace {

TEST(EffectPaths, AMethodCarriesWhatItsLightPathsSay) {
  LightPaths paths;
  paths.max_bounces = 2;
  paths.glossy_at_eye = true;
  EXPECT_TRUE(carries(paths, {.bounces = 0}));
  EXPECT_TRUE(carries(paths, {.bounces = 0, .glossy_at_eye = true}));
  EXPECT_TRUE(carries(paths, {.bounces = 2, .glossy_at_eye = true}));
  EXPECT_FALSE(carries(paths, {.bounces = 3}));
  EXPECT_FALSE(carries(paths, {.bounces = 2, .or_more = true}));
  EXPECT_FALSE(carries(paths, {.bounces = 1, .glossy_interior = true}));
  EXPECT_FALSE(carries(paths, {.bounces = 1, .end = LightEnd::environment}));
  EXPECT_FALSE(carries(paths, {.bounces = -1, .end = LightEnd::area}));
  EXPECT_TRUE(carries(paths, {.bounces = 0, .end = LightEnd::area}));  // of a rectangle or disc
  paths.glossy_at_eye = false, paths.environment = paths.emission = true;
  EXPECT_TRUE(carries(paths, {.bounces = 0, .glossy_at_eye = true}));  // direct light has both lobes
  EXPECT_FALSE(carries(paths, {.bounces = 1, .glossy_at_eye = true}));
  EXPECT_TRUE(carries(paths, {.bounces = 1, .end = LightEnd::environment}));
  EXPECT_TRUE(carries(paths, {.bounces = -1, .end = LightEnd::environment}));
}

// Red if classes that some choice of levels tells apart share a group (tried: the group taken from the last
// choice alone: bounces 1 to 3 become one group).
TEST(EffectPaths, ClassesShareAGroupOnlyIfAllChoicesTreatThemAlike) {
  const auto method = make_planted_method();
  const KnobValues knobs(method->knobs());
  const std::vector<Effect> effects = method->effects(knobs);
  EffectPaths paths(*method, knobs, effects);
  ASSERT_EQ(paths.everything(), (Levels{3, 3}));
  const size_t direct = paths.group_of({.bounces = 0}), one = paths.group_of({.bounces = 1}),
               three = paths.group_of({.bounces = 3}),
               beyond = paths.group_of({.bounces = 4, .or_more = true}),
               glossy = paths.group_of({.bounces = 2, .glossy_at_eye = true});
  EXPECT_EQ(std::set<size_t>({direct, one, three, beyond}).size(), 4u);
  EXPECT_EQ(glossy, beyond);  // never carried
  EXPECT_EQ(paths.group_of({.bounces = 0, .glossy_at_eye = true}), direct);
  EXPECT_EQ(paths.lost({3, 3}, {1, 3}), (std::vector<uint8_t>{0, 0, 1, 0}));
  EXPECT_EQ(paths.lost({3, 3}, {0, 0}), (std::vector<uint8_t>{0, 1, 1, 0}));
  EXPECT_EQ(paths.knobs({2, 0}).integer("depth"), 2);
  EXPECT_EQ(paths.knobs({2, 0}).integer("terms"), 1);
}

TEST(EffectPaths, AnEffectWithOneLevelIsRefusedByName) {
  const auto method = make_planted_method();
  const KnobValues knobs(method->knobs());
  const std::vector<Effect> effects = {{"lonely", "One level.", {{"on", {}}}}};
  try {
    EffectPaths paths(*method, knobs, effects);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("lonely"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace relight::test
