// Light parameters and the validation of lighting states.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/lights/light_words.h"
#include "common/run/error.h"

namespace relight {
namespace {

Light spot() {
  Light light;
  light.name = "lamp";
  light.type = LightType::spot;
  light.direction = {0, -2, 0};
  light.inner_degrees = 20.0f;
  light.outer_degrees = 30.0f;
  return light;
}

// Red if a name is missing, or stands in another place than its type has in the enumeration.
TEST(LightTypes, HaveNamesThatAreReadBack) {
  ASSERT_EQ(light_type_names().size(), static_cast<size_t>(light_type_count));
  EXPECT_EQ(to_string(LightType::rectangle), "rectangle");
  for (const std::string& name : light_type_names()) EXPECT_EQ(to_string(light_type_of(name)), name);
  try {
    light_type_of("sun");
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    for (const char* word : {"'sun'", "omni", "spot", "directional", "rectangle", "disc"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

// Red if the cosines are swapped, degrees are taken for radians, or the axis is not normalised.
TEST(LightParams, SpotIsFullInsideZeroOutsideAndHalfAtTheMiddleCosine) {
  const shader::LightParams params = spot().params();
  const auto at = [&](double degrees) {
    const double a = degrees * 3.14159265358979 / 180.0;
    return shader::light_intensity(params, glm::vec3(std::sin(a), -std::cos(a), 0.0)).x;
  };
  EXPECT_FLOAT_EQ(at(0.0), 1.0f);
  EXPECT_FLOAT_EQ(at(19.9), 1.0f);
  EXPECT_EQ(at(30.1), 0.0f);
  const double middle =
      0.5 * (std::cos(20.0 * 3.14159265358979 / 180.0) + std::cos(30.0 * 3.14159265358979 / 180.0));
  EXPECT_NEAR(at(std::acos(middle) * 180.0 / 3.14159265358979), 0.5f, 1e-4f);
}

// Red if an omni light inherits a cone.
TEST(LightParams, OmniIsTheSameInAllDirections) {
  Light light;
  light.direction = glm::vec3(0.0f);
  for (const glm::vec3 d : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)})
    EXPECT_EQ(shader::light_intensity(light.params(), d), glm::vec3(1.0f));
}

struct WrongLight {
  const char* field;
  void (*spoil)(Light&);
};
// Named in the list of tests by the field, not by the bytes of a function pointer.
void PrintTo(const WrongLight& wrong, std::ostream* out) { *out << wrong.field; }
class WrongLights : public testing::TestWithParam<WrongLight> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongLights,
    testing::Values(
        WrongLight{"position", [](Light& l) { l.position.x = std::numeric_limits<float>::infinity(); }},
        WrongLight{"intensity", [](Light& l) { l.intensity.y = -1.0f; }},
        WrongLight{"intensity", [](Light& l) { l.intensity.z = NAN; }},
        WrongLight{"direction", [](Light& l) { l.direction = glm::vec3(0.0f); }},
        WrongLight{"direction", [](Light& l) { l.direction.x = NAN; }},
        WrongLight{"outer_degrees", [](Light& l) { l.outer_degrees = l.inner_degrees; }},
        WrongLight{"outer_degrees", [](Light& l) { l.outer_degrees = 90.0f; }},
        WrongLight{"inner_degrees", [](Light& l) { l.inner_degrees = -1.0f; }},
        WrongLight{"inner_degrees", [](Light& l) { l.inner_degrees = NAN; }},
        WrongLight{"too close", [](Light& l) { l.inner_degrees = 0.0f, l.outer_degrees = 0.001f; }}));

// Red if a value that would make NaN or negative light passes.
TEST_P(WrongLights, AreRefusedNamingTheLightAndTheField) {
  LightingState lighting{"preset", {spot()}};
  EXPECT_NO_THROW(validate(lighting));
  GetParam().spoil(lighting.lights[0]);
  try {
    validate(lighting);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("lamp"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(GetParam().field), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace relight
