// Lights from TOML files: values, defaults, and errors that name file, line and field.
#include <fstream>

#include "common/scene/files/light_file.h"
#include "tests/run/error_message.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

// The lights of a file that holds `text`.
LightingState load(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "evening.toml";
  std::ofstream(file) << text;
  return load_lighting_file(file);
}

Light load_one(const std::string& text) { return load("[[light]]\n" + text).lights.at(0); }

void expect_near(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-5f) << a.x << " " << a.y << " " << a.z;
}

// Red if: the strength is read from another key, the direction is kept as long as it was written, or
// a directional light wants a position.
TEST(LightFile, ReadsDirectionalLights) {
  const Light light = load_one("type = \"directional\"\nirradiance = [3, 2, 1]\ndirection = [0, -2, 2]\n");
  EXPECT_EQ(light.type, LightType::directional);
  EXPECT_EQ(light.name, "directional");
  EXPECT_EQ(light.intensity, glm::vec3(3, 2, 1));
  expect_near(light.direction, {0, -std::sqrt(0.5f), std::sqrt(0.5f)});
  EXPECT_TRUE(light.casts_shadows);
  EXPECT_FALSE(
      load_one("type = \"directional\"\nirradiance = 1\ndirection = [0, -1, 0]\ncasts_shadows = false\n")
          .casts_shadows);
}

// Half edges: from the centre to the middles of two sides; the width is horizontal. Red if: width and
// height are swapped, whole instead of half, or `up` is ignored.
TEST(LightFile, ReadsRectangles) {
  const std::string common =
      "type = \"rectangle\"\nname = \"panel\"\nradiance = 5\nposition = [1, 2, 3]\n"
      "width = 4\nheight = 2\n";
  const Light wall = load_one(common + "direction = [0, 0, 3]\n");
  EXPECT_EQ(wall.type, LightType::rectangle);
  EXPECT_EQ(wall.name, "panel");
  EXPECT_EQ(wall.intensity, glm::vec3(5.0f));
  EXPECT_EQ(wall.position, glm::vec3(1, 2, 3));
  expect_near(wall.direction, {0, 0, 1});
  expect_near(glm::abs(wall.edge_u), {2, 0, 0});
  expect_near(glm::abs(wall.edge_v), {0, 1, 0});

  const Light turned = load_one(common + "target = [1, 2, 9]\nup = [1, 0, 0]\n");
  expect_near(turned.direction, {0, 0, 1});
  expect_near(glm::abs(turned.edge_u), {0, 2, 0});
  expect_near(glm::abs(turned.edge_v), {1, 0, 0});

  // Straight down, where +y is no help: +z is up.
  const Light ceiling = load_one(common + "direction = [0, -1, 0]\n");
  expect_near(glm::abs(ceiling.edge_u), {2, 0, 0});
  expect_near(glm::abs(ceiling.edge_v), {0, 0, 1});

  // Whatever way it faces, edges and direction stand at right angles.
  const Light any = load_one(common + "direction = [0.3, -0.8, 0.5]\n");
  EXPECT_NEAR(glm::dot(any.edge_u, any.direction), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(any.edge_v, any.direction), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(any.edge_u, any.edge_v), 0.0f, 1e-6f);
  EXPECT_NEAR(any.edge_u.y, 0.0f, 1e-6f) << "the width is horizontal";
}

// Red if: the radius is taken for a diameter, or the target for a direction.
TEST(LightFile, ReadsDiscs) {
  const Light light = load_one(
      "type = \"disc\"\nradiance = [1, 0, 2]\nposition = [0, 4, 0]\ntarget = [3, 0, 0]\nradius = 0.5\n");
  EXPECT_EQ(light.type, LightType::disc);
  EXPECT_EQ(light.intensity, glm::vec3(1, 0, 2));
  EXPECT_EQ(light.radius, 0.5f);
  expect_near(light.direction, {0.6f, -0.8f, 0.0f});
}

// Red if: lights are read in another order, or the name of the file is not that of the lighting.
TEST(LightFile, ReadsAllLightsInTheirOrder) {
  const std::string omni = "[[light]]\ntype = \"omni\"\nposition = [0, 1, 0]\nintensity = 1\n";
  const LightingState lights =
      load(omni + "[[light]]\ntype = \"directional\"\nirradiance = 1\ndirection = [0, -1, 0]\n" + omni);
  ASSERT_EQ(lights.lights.size(), 3u);
  EXPECT_EQ(lights.lights[1].type, LightType::directional);
  EXPECT_EQ(lights.name, "evening");
}

struct BadLight {
  const char* name;
  const char* text;  // after [[light]], which is line 1
  std::vector<std::string> parts;
};
void PrintTo(const BadLight& bad, std::ostream* out) { *out << bad.name; }
class BadLights : public testing::TestWithParam<BadLight> {};

#define RECTANGLE "type = \"rectangle\"\nradiance = 1\nposition = [0, 1, 0]\n"
#define DISC "type = \"disc\"\nradiance = 1\nposition = [0, 1, 0]\n"
INSTANTIATE_TEST_SUITE_P(
    All, BadLights,
    testing::Values(
        BadLight{"no_type", "intensity = 1\n", {":1: light[1]", "'type' is missing"}},
        BadLight{"unknown_type",
                 "type = \"area\"\n",
                 {":2: light[1].type", "'area'", "omni, spot, directional, rectangle, disc"}},
        BadLight{"directional_intensity",
                 "type = \"directional\"\nintensity = 1\n",
                 {"light[1]", "'irradiance' is missing"}},
        BadLight{"directional_position",
                 "type = \"directional\"\nirradiance = 1\ndirection = [0, -1, 0]\nposition = [0, 0, 0]\n",
                 {":5: light[1].position", "not known"}},
        BadLight{"directional_target",
                 "type = \"directional\"\nirradiance = 1\ntarget = [0, -1, 0]\n",
                 {"light[1]", "'direction' is missing"}},
        BadLight{"directional_zero",
                 "type = \"directional\"\nirradiance = 1\ndirection = [0, 0, 0]\n",
                 {":4: light[1].direction", "no length"}},
        BadLight{"negative_irradiance",
                 "type = \"directional\"\nirradiance = [1, -1, 1]\n",
                 {":3: light[1].irradiance", "-1", ">= 0"}},
        BadLight{"rectangle_intensity",
                 "type = \"rectangle\"\nintensity = 1\n",
                 {"light[1]", "'radiance' is missing"}},
        BadLight{"rectangle_no_position",
                 "type = \"rectangle\"\nradiance = 1\n",
                 {"light[1]", "'position' is missing"}},
        BadLight{"rectangle_no_axis",
                 RECTANGLE "width = 1\nheight = 1\n",
                 {"light[1]", "either direction or target"}},
        BadLight{"rectangle_two_axes",
                 RECTANGLE "width = 1\nheight = 1\ntarget = [0, 0, 0]\ndirection = [0, 1, 0]\n",
                 {"light[1]", "either direction or target"}},
        BadLight{"rectangle_no_width",
                 RECTANGLE "target = [0, 0, 0]\nheight = 1\n",
                 {"light[1]", "'width' is missing"}},
        BadLight{"rectangle_no_height",
                 RECTANGLE "target = [0, 0, 0]\nwidth = 1\n",
                 {"light[1]", "'height' is missing"}},
        BadLight{"rectangle_zero_width",
                 RECTANGLE "target = [0, 0, 0]\nwidth = 0\nheight = 1\n",
                 {":6: light[1].width", "> 0"}},
        BadLight{"rectangle_negative_height",
                 RECTANGLE "target = [0, 0, 0]\nwidth = 1\nheight = -2\n",
                 {":7: light[1].height", "-2", "> 0"}},
        BadLight{"rectangle_up_parallel",
                 RECTANGLE "direction = [0, 0, 1]\nwidth = 1\nheight = 1\nup = [0, 0, -3]\n",
                 {":8: light[1].up", "parallel"}},
        BadLight{"rectangle_target_at_centre",
                 RECTANGLE "target = [0, 1, 0]\nwidth = 1\nheight = 1\n",
                 {":5: light[1].target", "no length"}},
        BadLight{"rectangle_huge",
                 RECTANGLE "target = [0, 0, 0]\nwidth = 1e25\nheight = 1e25\n",
                 {"rectangle", "needs an area"}},
        BadLight{"rectangle_radius",
                 RECTANGLE "target = [0, 0, 0]\nwidth = 1\nheight = 1\nradius = 1\n",
                 {":8: light[1].radius", "not known"}},
        BadLight{"disc_no_radius", DISC "target = [0, 0, 0]\n", {"light[1]", "'radius' is missing"}},
        BadLight{"disc_zero_radius", DISC "target = [0, 0, 0]\nradius = 0\n", {":6: light[1].radius", "> 0"}},
        BadLight{"disc_no_axis", DISC "radius = 1\n", {"light[1]", "either direction or target"}},
        BadLight{"disc_text_radius",
                 DISC "target = [0, 0, 0]\nradius = \"wide\"\n",
                 {":6: light[1].radius", "not a number"}},
        BadLight{"disc_width",
                 DISC "target = [0, 0, 0]\nradius = 1\nwidth = 1\n",
                 {":7: light[1].width", "not known"}}),
    [](const auto& test) { return std::string(test.param.name); });
#undef RECTANGLE
#undef DISC

// Red if: a range is not checked, a key of another type of light passes, or a required one has a
// default.
TEST_P(BadLights, AreRefusedNamingFileLineAndField) {
  const std::string message = error_message([] { load(std::string("[[light]]\n") + GetParam().text); });
  for (const std::string& part : GetParam().parts)
    EXPECT_NE(message.find(part), std::string::npos) << message;
  const bool by_value =
      message.find("needs an area") != std::string::npos;  // found after reading; names the light
  EXPECT_TRUE(by_value || message.find("evening.toml:") != std::string::npos) << message;
}

// Methods that shade with light_models.glsl must not take a rectangle for a directional light. Red if:
// params() gives it a form.
TEST(LightParams, RefuseLightsWithAnArea) {
  for (const LightType type : {LightType::rectangle, LightType::disc}) {
    Light light;
    light.name = "panel";
    light.type = type;
    EXPECT_NE(error_message([&] { light.params(); }).find("panel"), std::string::npos);
  }
}

// Made by code, not by files. Red if: skewed edges pass, which rays and drawn points take for
// different shapes.
TEST(LightingStates, RefuseRectanglesThatAreNone) {
  const auto lights = [](const glm::vec3& direction, const glm::vec3& u, const glm::vec3& v) {
    Light light;
    light.name = "panel";
    light.type = LightType::rectangle;
    light.direction = direction, light.edge_u = u, light.edge_v = v;
    return LightingState{"made", {light}};
  };
  EXPECT_NO_THROW(validate(lights({0, -1, 0}, {2, 0, 0}, {0, 0, 1})));
  for (const LightingState& bad :
       {lights({0, -1, 0}, {2, 0, 0}, {1, 0, 1}), lights({0, -1, 0.2f}, {2, 0, 0}, {0, 0, 1}),
        lights({0, -1, 0}, {2, 0, 0}, {1, 0, 0}), lights({1, 0, 0}, {2, 0, 0}, {0, 0, 1})}) {
    const std::string message = error_message([&] { validate(bad); });
    EXPECT_NE(message.find("panel"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace relight
