// Projectors, uber-lights, daylight and light shaders from TOML: values, defaults, and refusals that name
// file, line, field and what is valid.
#include <fstream>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/lights/light_words.h"
#include "common/scene/files/light_file.h"
#include "common/shading/light_cache.h"
#include "tests/run/error_message.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

// In a folder that holds the image 3 x 2 "slide.exr" and the shader "lamp.glsl".
LightingState load(const std::string& text) {
  const TemporaryFolder folder;
  Image slide(3, 2);
  slide.at(2, 0) = glm::vec3(7.0f);
  write_exr(folder.path() / "slide.exr", slide);
  std::ofstream(folder.path() / "lamp.glsl") << "vec3 user_light() {}\n";
  std::ofstream(folder.path() / "evening.toml") << "[[light]]\n" << text;
  return load_lighting_file(folder.path() / "evening.toml");
}

const std::string at = "position = [0, 1, 0]\ntarget = [0, 0, 0]\n";  // steep: +z is up
const std::string projector = "type = \"projector\"\nintensity = 2\nimage = \"slide.exr\"\n" + at;
const std::string uber = "type = \"uber\"\nintensity = 2\n" + at;
const std::string sky = "type = \"sun_sky\"\nelevation_degrees = 30\n";
const std::string shader_light = "type = \"shader\"\nintensity = 2\nfile = \"lamp.glsl\"\n" + at;

// Red if fov is taken for the half-angle; the aspect of the image is not the default; rows upside
// down.
TEST(LightFiles, ReadProjectors) {
  const Light light = load(projector + "fov_degrees = 90\n").lights.at(0);
  EXPECT_NEAR(light.beam.width, 1.0f, 1e-6f);
  EXPECT_NEAR(light.beam.height, 2.0f / 3.0f, 1e-6f);
  EXPECT_EQ(light.beam.width_edge, 0.0f);
  ASSERT_TRUE(light.slide);
  EXPECT_EQ(light.slide->width, 3);
  EXPECT_EQ(light.slide->texels.at(2).x, 7.0f) << "the upper right texel";
  EXPECT_NEAR(load(projector + "aspect = 2\n").lights.at(0).beam.height, 0.5f * std::tan(glm::radians(20.0f)),
              1e-6f);
}

TEST(LightFiles, ReadUberLightsWithTheDefaultsOfTheDocumentation) {
  const Light light = load(uber).lights.at(0);
  EXPECT_EQ(light.beam, BeamShape::uber());
  EXPECT_FALSE(light.slide);
  const Light all =
      load(uber +
           "width = 1\nheight = 2\nwidth_edge = 3\nheight_edge = 4\nroundness = 0.5\nshear_x = 6\n"
           "shear_y = 7\ncut_on = 8\nnear_edge = 9\ncut_off = 10\nfar_edge = 11\nfalloff = 1\n"
           "falloff_distance = 13\nimage = \"slide.exr\"\n")
          .lights.at(0);
  EXPECT_EQ(all.beam, (BeamShape{1, 2, 3, 4, 0.5f, 6, 7, 8, 9, 10, 11, 1, 13}));
  EXPECT_TRUE(all.slide);
}

// Red if the lighting keeps the scene's environment, or the sun shines upwards.
TEST(LightFiles, ReadDaylightAsSunAndSky) {
  const LightingState lighting = load(sky + "azimuth_degrees = 90\nscale = 0.5\n");
  const Light& sun = lighting.lights.at(0);
  EXPECT_NEAR(sun.direction.y, -0.5f, 1e-6f);
  EXPECT_LT(sun.direction.x, -0.8f) << "from +x";
  EXPECT_GT(sun.intensity.x, 100.0f);
  ASSERT_TRUE(lighting.environment);
  EXPECT_GT(lighting.environment->lookup({0, 1, 0}).z, 0.0f);
  EXPECT_EQ(&lighting.environment_or(Environment()), lighting.environment.get());
}

TEST(LightFiles, ReadShadersWithTheirParameters) {
  const Light light = load(shader_light + "parameter_1 = 4\nparameter_8 = [1, 2, 3]\n").lights.at(0);
  EXPECT_EQ(light.user_shader->text, "vec3 user_light() {}\n");
  EXPECT_EQ(light.parameters[0], glm::vec3(4.0f));
  EXPECT_EQ(light.parameters[6], glm::vec3(0.0f));
  EXPECT_EQ(light.parameters[7], glm::vec3(1, 2, 3));
}

// Stored references and cached pictures are known by these words, light caches by same_light: what changes
// the light must change both. Red if a field is left out of either (tried: the beam, in same_light).
TEST(LightFiles, EveryFieldIsInTheDescriptionAndInTheComparison) {
  const std::vector<std::string> variants = {
      uber,
      uber + "width = 1\n",
      uber + "height = 1\n",
      uber + "width_edge = 1\n",
      uber + "height_edge = 1\n",
      uber + "roundness = 0\n",
      uber + "shear_x = 1\n",
      uber + "shear_y = 1\n",
      uber + "cut_on = 1\n",
      uber + "near_edge = 1\n",
      uber + "cut_off = 1\n",
      uber + "far_edge = 1\n",
      uber + "falloff = 1\n",
      uber + "falloff_distance = 2\n",
      uber + "up = [1, 0, 0]\n",
      uber + "image = \"slide.exr\"\n",
      projector,
      projector + "fov_degrees = 20\n",
      projector + "aspect = 1\n",
      sky,
      sky + "turbidity = 4\n",
      sky + "azimuth_degrees = 4\n",
      sky + "scale = 4\n",
      shader_light,
      shader_light + "parameter_1 = 1\n",
      shader_light + "parameter_8 = 1\n",
  };
  std::vector<Light> lights;
  for (const std::string& text : variants) lights.push_back(load(text).lights.at(0));
  for (size_t i = 0; i < lights.size(); ++i)
    for (size_t k = 0; k < lights.size(); ++k) {
      EXPECT_EQ(same_light(lights[i], lights[k]), i == k) << variants[i] << variants[k];
      EXPECT_EQ(describe(lights[i]) == describe(lights[k]), i == k) << variants[i] << variants[k];
    }
}

// The words of the lights that stored references hold. Red if a light of another type changes them.
TEST(LightFiles, TheWordsOfOlderLightsStay) {
  EXPECT_EQ(describe(load("type = \"omni\"\nposition = [0, 1, 2]\nintensity = 3\n").lights.at(0)),
            "omni position (0, 1, 2) direction (0, -1, 0) intensity (3, 3, 3)");
  EXPECT_EQ(describe(load("type = \"spot\"\nintensity = 3\nouter_degrees = 20\n" + at).lights.at(0)),
            "spot position (0, 1, 0) direction (0, -1, 0) intensity (3, 3, 3) inner 16 outer 20 degrees");
}

struct Bad {
  const char* name;
  std::string text;
  std::vector<std::string> parts;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }
class BadLightFiles : public testing::TestWithParam<Bad> {};
INSTANTIATE_TEST_SUITE_P(
    All, BadLightFiles,
    testing::Values(
        Bad{"no_image", "type = \"projector\"\nintensity = 1\n" + at, {"'image' is missing"}},
        Bad{"image_not_there",
            "type = \"projector\"\nintensity = 1\nimage = \"none.png\"\n" + at,
            {":4: light[1].image", "none.png"}},
        Bad{"fov", projector + "fov_degrees = 180\n", {":7:", "fov_degrees", "180", "<= 170"}},
        Bad{"aspect", projector + "aspect = 0\n", {":7:", "aspect", ">= 0.001"}},
        Bad{"projector_up", projector + "up = [0, 2, 0]\n", {":7:", "up", "parallel"}},
        Bad{"projector_width", projector + "width = 1\n", {":7:", "width", "not known", "fov_degrees"}},
        Bad{"width", uber + "width = 0\n", {":6:", "width", "> 0"}},
        Bad{"width_edge", uber + "width_edge = -1\n", {":6:", "width_edge", ">= 0"}},
        Bad{"roundness", uber + "roundness = 1.5\n", {":6:", "roundness", "1.5", "<= 1"}},
        Bad{"cuts", uber + "cut_on = 3\ncut_off = 2\n", {":6:", "cut_on", "3", "cut_off = 2"}},
        Bad{"near_edge", uber + "near_edge = -0.1\n", {":6:", "near_edge", ">= 0"}},
        Bad{"falloff", uber + "falloff = 11\n", {":6:", "falloff", "<= 10"}},
        Bad{"falloff_distance", uber + "falloff_distance = 0\n", {":6:", "falloff_distance", "> 0"}},
        Bad{"low_sun", "type = \"sun_sky\"\nelevation_degrees = 1\n", {":3:", "elevation_degrees", ">= 2"}},
        Bad{"turbidity", sky + "turbidity = 11\n", {":4:", "turbidity", "11", "<= 10"}},
        Bad{"clear", sky + "turbidity = 1.9\n", {":4:", "turbidity", ">= 2"}},
        Bad{"scale", sky + "scale = -1\n", {":4:", "scale", ">= 0"}},
        Bad{"two_skies", sky + "[[light]]\n" + sky, {"more than one", "sun_sky"}},
        Bad{"no_shader", "type = \"shader\"\nintensity = 1\n" + at, {"'file' is missing"}},
        Bad{"shader_not_there",
            "type = \"shader\"\nintensity = 1\nfile = \"none.glsl\"\n" + at,
            {":4: light[1].file", "none.glsl"}},
        Bad{"parameter_9",
            shader_light + "parameter_9 = 1\n",
            {":7:", "parameter_9", "not known", "parameter_8"}},
        Bad{"area_without_shadows",
            "type = \"disc\"\nradiance = 1\nradius = 1\ncasts_shadows = false\n" + at,
            {"'disc'", "casts_shadows", "true"}}),
    [](const auto& test) { return std::string(test.param.name); });

// Red if a range is left out of the table of fields.
TEST_P(BadLightFiles, AreRefusedNamingTheField) {
  const std::string message = error_message([] { load(GetParam().text); });
  for (const std::string& part : GetParam().parts)
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace relight
