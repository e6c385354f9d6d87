// Light shaders that users write in GLSL.
#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/shading/block_lighting.h"
#include "common/shading/direct_lighting.h"
#include "reference/light_sampler.h"
#include "tests/lights/light_cases.h"
#include "tests/run/error_message.h"
#include "tests/shading/shading_fixture.h"

namespace relight {
namespace {

Light user_light(const std::string& text) {
  static uint64_t number = 0;
  Light light = test::spot_light({-1.5f, 1.5f, 1.5f}, glm::normalize(glm::vec3(1, -1.2f, -1)), 35.0f);
  light.name = "mine";
  light.type = LightType::shader;
  light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0, 1, 0)));
  light.user_shader =
      std::make_shared<const UserLightShader>(UserLightShader{"lamps/mine.glsl", text, ++number});
  return light;
}

struct Room {
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  Scene scene = test::room_scene();
  RayTracer tracer{scene};
  std::vector<SurfaceSample> samples = test::random_samples(tracer, 4000);
  std::vector<glm::vec3> shade(const Light& light, Shadows shadows = Shadows::traced) {
    DirectLighting shading(*context, scene, tracer, {shadows, 256});
    StageLog log;
    return test::shade(shading, samples, {0, 0, 1}, {"one", {light}}, Lobes::diffuse, log);
  }
};

// A spot written again as a user's shader gives what the spot gives: frame, distance, parameters and shadows
// all reach it. Stated bound: 2e-5 of rounding_scale_of (the cone's slope). Red if (tried): `away` in the
// scene's frame; a parameter shifted by one.
TEST(UserLight, CanBeASpot) {
  Room room;
  Light spot = test::spot_light({-1.5f, 1.5f, 1.5f}, glm::normalize(glm::vec3(1, -1.2f, -1)), 35.0f);
  Light mine = user_light(
      "vec3 user_light(vec3 away, float distance, vec3 parameters[8]) {\n"
      "  float t = clamp((away.z - parameters[1].x) / (parameters[0].x - parameters[1].x), 0.0, 1.0);\n"
      "  return parameters[7] * (t * t * (3.0 - 2.0 * t));\n"
      "}\n");
  const shader::LightParams params = spot.params();
  mine.parameters[0] = glm::vec3(params.intensity_inner.w);
  mine.parameters[1] = glm::vec3(params.direction_outer.w);
  mine.parameters[7] = glm::vec3(1, 0.5f, 0.25f);
  spot.intensity = mine.intensity * mine.parameters[7];
  const auto scale = test::rounding_scale_of(room.samples, {emitter_of(spot)});
  for (const Shadows shadows : {Shadows::traced, Shadows::map}) {
    const auto expected = room.shade(spot, shadows), got = room.shade(mine, shadows);
    size_t lit = 0, different = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      lit += expected[i] != glm::vec3(0.0f);
      different += test::largest_error({got[i]}, {expected[i]}, {scale[i]}) > 2e-5f;
    }
    EXPECT_GT(lit, 100u);
    // With maps the spot has one, the user's light six: they differ at shadow edges.
    EXPECT_LE(different, shadows == Shadows::traced ? 0u : room.samples.size() / 50);
  }
}

// Red if (tried): messages name the file that stands in.
TEST(UserLight, ErrorsNameTheUsersFileAndLine) {
  Room room;
  const Light light = user_light(
      "vec3 user_light(vec3 away, float distance, vec3 parameters[8]) {\n"
      "  vec3 colour = vec3(1.0);\n"
      "  return color;\n"
      "}\n");
  const std::string message = error_message([&] { room.shade(light); });
  for (const char* part : {"lamps/mine.glsl:3:", "color", "return color;"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  const std::string none = error_message([&] { room.shade(user_light("float nothing;\n")); });
  EXPECT_NE(none.find("user_light"), std::string::npos) << none;
}

// Red if (tried): the CPU shades it as a bare point.
TEST(UserLight, IsRefusedOnTheCpuNamingWhatIsValid) {
  Room room;
  const Light light = user_light("");
  const LightingState lighting{"one", {light}};
  BlockLighting blocks(room.tracer);
  StageLog log;
  for (const std::string& message :
       {error_message([&] { shade_direct_cpu(room.tracer, room.samples, {}, lighting, Lobes::diffuse); }),
        error_message([&] { blocks.shade(lighting.lights, {}, Onto::nothing, log); }),
        error_message([&] { LightSampler sampler(lighting); })})
    for (const char* part : {"'mine'", "lamps/mine.glsl", "GPU only", "omni, spot", "uber"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace relight
