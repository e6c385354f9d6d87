// Keyframes: values between them, lights made of them, and what lighting files may say.
#include <fstream>

#include <gtest/gtest.h>

#include "common/lights/light_animation.h"
#include "common/scene/files/light_file.h"
#include "common/shading/light_cache.h"
#include "tests/run/error_message.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

LightingState load(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "moving.toml";
  std::ofstream(file) << text;
  return load_lighting_file(file);
}

const std::string moving =
    "[[light]]\ntype = \"spot\"\nname = \"beam\"\nposition = [0, 2, 0]\ndirection = [0, -1, 0]\n"
    "intensity = 10\nouter_degrees = 20\n"
    "[[light.keyframe]]\ntime = 1\nposition = [0, 2, 0]\ndirection = [0, -1, 0]\n"
    "[[light.keyframe]]\ntime = 3\nposition = [4, 2, 0]\ndirection = [1, 0, 0]\nintensity = [10, 0, 2]\n"
    "[[light.keyframe]]\ntime = 4\nposition = [4, 4, 0]\nintensity = 20\nouter_degrees = 30\n"
    "[[light]]\ntype = \"omni\"\nposition = [1, 1, 1]\nintensity = 1\n";

void expect_near(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-5f) << a.x << " " << a.y << " " << a.z;
}

// Red if (tried): the first value returns after the last keyframe; or if a track needs every field in every
// keyframe, or directions are not normalised.
TEST(Keyframes, AreLinearAndHeldAtTheEnds) {
  const LightingState lighting = load(moving);
  ASSERT_TRUE(lighting.animation);
  EXPECT_EQ(lighting.animation->first_time(), 1.0);
  EXPECT_EQ(lighting.animation->last_time(), 4.0);
  const auto at = [&](double time) { return lighting_at(lighting, time).lights.at(0); };
  expect_near(at(0.0).position, {0, 2, 0});
  expect_near(at(2.0).position, {2, 2, 0});
  expect_near(at(3.5).position, {4, 3, 0});
  expect_near(at(9.0).position, {4, 4, 0});
  expect_near(at(2.0).direction, glm::normalize(glm::vec3(1, -1, 0)));
  expect_near(at(3.7).direction, {1, 0, 0});
  expect_near(at(2.0).intensity, {10, 0, 2});  // its track begins at 3 s
  expect_near(at(3.5).intensity, {15, 10, 11});
  EXPECT_EQ(at(0.0).outer_degrees, 30.0f) << "one keyframe holds for ever";
  EXPECT_FALSE(lighting_at(lighting, 2.0).animation);
}

// The light cache knows a light by its bits. Red if (tried): lights without tracks move by a
// millionth.
TEST(Keyframes, LeaveStandingLightsTheSameBitByBit) {
  const LightingState lighting = load(moving);
  for (const double time : {0.0, 1.3, 2.9, 5.0}) {
    EXPECT_TRUE(same_light(lighting_at(lighting, time).lights[1], lighting.lights[1]));
  }
  EXPECT_TRUE(same_light(lighting_at(lighting, 4.0).lights[0], lighting_at(lighting, 7.0).lights[0]));
  EXPECT_TRUE(same_light(lighting_at(lighting, 0.2).lights[0], lighting_at(lighting, 0.9).lights[0]));
  EXPECT_FALSE(same_light(lighting_at(lighting, 1.2).lights[0], lighting_at(lighting, 1.3).lights[0]));
}

// Against the uniform Catmull-Rom formula, and on a straight line at uneven times, where the spline must be
// the line. Red if (tried): tangents are divided by the span of one interval; colours are splined too.
TEST(Keyframes, FollowCatmullRomSplinesWhereAsked) {
  LightTrack track;
  track.field = "position";
  track.spline = true;
  track.times = {0, 1, 2, 3};
  track.values = {{0, 0, 0}, {1, 2, 0}, {3, 1, 0}, {4, 4, 0}};
  const double t = 0.3;
  const auto formula = [&](int c) {
    const double p0 = track.values[0][c], p1 = track.values[1][c], p2 = track.values[2][c],
                 p3 = track.values[3][c];
    return 0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t * t +
                  (3 * p1 - p0 - 3 * p2 + p3) * t * t * t);
  };
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(track.at(1.0 + t)[c], formula(c), 1e-6);
  expect_near(track.at(1.0), track.values[1]);
  track.times = {0, 1, 3, 3.5};
  track.values = {{0, 0, 0}, {2, 0, 0}, {6, 0, 0}, {7, 0, 0}};
  for (const double time : {0.3, 1.7, 2.9, 3.2}) EXPECT_NEAR(track.at(time).x, 2.0 * time, 1e-5);

  const LightingState lighting = load(
      "[[light]]\ntype = \"omni\"\nposition = [0, 0, 0]\nintensity = 1\nmotion = \"catmull_rom\"\n"
      "[[light.keyframe]]\ntime = 0\nposition = [0, 0, 0]\nintensity = 0\n"
      "[[light.keyframe]]\ntime = 1\nposition = [0, 1, 0]\nintensity = 0\n"
      "[[light.keyframe]]\ntime = 2\nposition = [0, 0, 0]\nintensity = 8\n"
      "[[light.keyframe]]\ntime = 3\nposition = [0, 0, 0]\nintensity = 0\n");
  EXPECT_GT(lighting_at(lighting, 0.5).lights[0].position.y, 0.6f) << "a line would be at 0.5";
  EXPECT_EQ(lighting_at(lighting, 0.5).lights[0].intensity.x, 0.0f) << "a spline would be below 0";
}

struct Bad {
  const char* name;
  std::string text;
  std::vector<std::string> parts;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }
class BadKeyframes : public testing::TestWithParam<Bad> {};
const std::string omni = "[[light]]\ntype = \"omni\"\nposition = [0, 1, 0]\nintensity = 1\n";  // 4 lines
const std::string spot =
    "[[light]]\ntype = \"spot\"\nposition = [0, 1, 0]\nintensity = 1\ntarget = [0, 0, 0]\n";
INSTANTIATE_TEST_SUITE_P(
    All, BadKeyframes,
    testing::Values(
        Bad{"no_time", omni + "[[light.keyframe]]\nintensity = 1\n", {":5:", "'time' is missing"}},
        Bad{"time_goes_back",
            omni +
                "[[light.keyframe]]\ntime = 1\nintensity = 1\n[[light.keyframe]]\ntime = 1\nintensity = 2\n",
            {":9:", "keyframe[2].time", "not after"}},
        Bad{"negative",
            omni + "[[light.keyframe]]\ntime = 1\nintensity = -1\n",
            {":7:", "intensity", ">= 0"}},
        Bad{"field_of_another_type",
            omni + "[[light.keyframe]]\ntime = 1\nradius = 1\n",
            {":7:", "radius", "not known", "position"}},
        Bad{"nothing_but_time", omni + "[[light.keyframe]]\ntime = 1\n", {":5:", "needs a field"}},
        Bad{"motion_without_keyframes", omni + "motion = \"linear\"\n", {":5:", "motion", "no keyframes"}},
        Bad{"unknown_motion",
            omni + "motion = \"bezier\"\n[[light.keyframe]]\ntime = 1\nintensity = 1\n",
            {":5:", "'bezier'", "linear, catmull_rom"}},
        Bad{"two_axes",
            spot + "[[light.keyframe]]\ntime = 2\ndirection = [0, -1, 0]\n",
            {"'spot'", "at 2 s", "either direction or target"}},
        Bad{"target_meets_light",
            spot + "[[light.keyframe]]\ntime = 2\ntarget = [0, 1, 0]\n",
            {"'spot'", "at 2 s", "target", "no length"}}),
    [](const auto& test) { return std::string(test.param.name); });

// Red if (tried): unknown keys or times that go back pass; values are checked only when a frame is due.
TEST_P(BadKeyframes, AreRefusedWhenTheFileIsRead) {
  const std::string message = error_message([] { load(GetParam().text); });
  for (const std::string& part : GetParam().parts)
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

// Between keyframes, which no check can foresee. Red if (tried): a light without direction is shaded.
TEST(Keyframes, ThatPassThroughNoDirectionAreRefusedByTime) {
  const LightingState lighting = load(
      "[[light]]\ntype = \"directional\"\nname = \"sun\"\ndirection = [0, -1, 0]\nirradiance = 1\n"
      "[[light.keyframe]]\ntime = 0\ndirection = [0, -1, 0]\n[[light.keyframe]]\ntime = 2\ndirection = [0, "
      "1, 0]\n");
  const std::string message = error_message([&] { lighting_at(lighting, 1.0); });
  for (const char* part : {"'sun'", "at 1 s", "direction", "no length"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace relight
