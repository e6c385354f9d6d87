// Directional lights: parallel light of a given irradiance.
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

Light directional(const glm::vec3& direction, const glm::vec3& irradiance = glm::vec3(1.0f)) {
  Light light;
  light.name = "directional";
  light.type = LightType::directional;
  light.direction = direction;
  light.intensity = irradiance;
  return light;
}

const glm::vec3 slant = glm::normalize(glm::vec3(0.25f, -0.4f, -1.0f));  // into the open room

// The same light from so far away that it differs by less than 1e-3 in angle and strength.
Light far_omni(const Light& light, float distance) {
  return omni(-distance * glm::normalize(light.direction), light.intensity * distance * distance);
}

// A floor with a box on it, seen from above.
Rendering floor_with_box() {
  Scene scene = empty_scene(glm::vec3(0.6f));
  add_quad(scene, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0});
  add_box(scene, {-0.2f, 0.5f, -0.2f}, {0.2f, 0.7f, 0.2f});
  scene.camera = {{0.013f, 4.0f, 0.017f}, {0.013f, 0, 0.017f}, {0, 0, 1}, 40.0f};
  finish_scene(scene);
  return Rendering(std::move(scene), 64, 48);
}

// albedo / pi x irradiance x cosine; the box casts its shadow along the light. Red if (each tried): the
// direction's sign or length enters, the cosine is lost, or the shadow ray goes the other way.
TEST(DirectionalLight, DirectLightIsTheCosineLawWithParallelShadows) {
  const Rendering render = floor_with_box();
  const glm::vec3 w = glm::normalize(glm::vec3(0.5f, -1.0f, 0.2f));
  const PathTracerResult result =
      render(lighting({directional(3.0f * w, {2.0f, 1.0f, 0.5f})}), settings(Estimator::next_event, 2, 2));
  const glm::vec3 open = 0.6f / 3.14159265f * -w.y * glm::vec3(2.0f, 1.0f, 0.5f);
  int lit = 0, dark = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      float expected = 0.0f;
      bool floor = true;
      for (int s = 0; s < 4; ++s) {
        const glm::vec3 p =
            render.buffer.direct[static_cast<size_t>((2 * y + s / 2) * 128 + 2 * x + s % 2)].position;
        floor = floor && p.y < 0.01f;
        // Where the ray to the light passes the box: both at its lower and its upper face, or between.
        bool shadow = false;
        for (int i = 0; i <= 100; ++i) {
          const glm::vec3 q = p - w * ((0.5f + 0.002f * static_cast<float>(i)) / -w.y);
          shadow = shadow || (std::abs(q.x) < 0.2f && std::abs(q.z) < 0.2f);
        }
        expected += shadow ? 0.0f : 0.25f;
      }
      if (!floor) continue;
      lit += expected == 1.0f, dark += expected == 0.0f;
      if (expected == 1.0f || expected == 0.0f) {
        EXPECT_NEAR(result.direct.at(x, y).x, expected * open.x, 1e-5f) << x << " " << y;
      }
      EXPECT_NEAR(result.direct.at(x, y).y, 0.5f * result.direct.at(x, y).x, 1e-6f);
    }
  EXPECT_GT(lit, 1000);
  EXPECT_GT(dark, 20);
}

// Red if (tried): the shadow ray has a fixed length, too short for a large scene.
TEST(DirectionalLight, IsTheSameInAMovedAndScaledRoom) {
  const PathTracerSettings s = settings(Estimator::next_event, 16, 2);
  const LightingState lights = lighting({directional(slant)});
  const Rendering here(room(2.0f), 12, 9), there(room(2000.0f, {5000.0f, -3000.0f, 1000.0f}), 12, 9);
  const Image a = here(lights, s).direct, b = there(lights, s).direct;
  EXPECT_GT(mean_of(a).x, 0.01);
  EXPECT_NEAR(mean_of(a).x, mean_of(b).x, 0.01 * mean_of(a).x);
}

// Shadow-free lights reach everything. The light comes from the side: straight from above, the box would hide
// its own shadow from the camera. Red if (tried): casts_shadows is ignored.
TEST(DirectionalLight, PassesThroughSurfacesWithoutShadows) {
  const Rendering render = floor_with_box();
  Light light = directional(glm::normalize(glm::vec3(0.5f, -1.0f, 0.2f)));
  const auto darkest = [&] {
    const Image direct = render(lighting({light}), settings(Estimator::next_event, 2, 2)).direct;
    return std::min_element(direct.pixels.begin(), direct.pixels.end(),
                            [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; })
        ->x;
  };
  EXPECT_EQ(darkest(), 0.0f) << "a shadow is in view";
  light.casts_shadows = false;
  EXPECT_NEAR(darkest(), 0.6f / 3.14159265f * -light.direction.y, 1e-5f);
}

// The light of `a` is that of all of `parts`, each rendered alone.
void expect_equal_light(const Rendering& render, const LightingState& a,
                        const std::vector<LightingState>& parts, Estimator estimator) {
  const PictureMean all(render, a, settings(estimator, 256, 2, bounces(1, 2), 1), 12);
  const double direct = mean_of(render(a, settings(estimator, 2, 2)).direct).x;
  double sum = 0.0, direct_sum = 0.0, variance = all.error * all.error;
  for (const LightingState& part : parts) {
    const PictureMean one(render, part, settings(Estimator::next_event, 256, 2, bounces(1, 2), 2), 12);
    sum += one.mean, variance += one.error * one.error;
    direct_sum += mean_of(render(part, settings(estimator, 2, 2)).direct).x;
  }
  EXPECT_NEAR(direct, direct_sum, 0.01 * direct_sum);
  // 7 standard errors of 22 degrees of freedom: a false alarm in 2e6. 0.002: what distance and edges change.
  const double error = 7.0 * std::sqrt(variance);
  EXPECT_LT(std::abs(all.mean - sum), error + 0.002 * sum) << all.mean << " against " << sum;
  EXPECT_LT(error, 0.04 * sum) << "too noisy to tell";
}

// One and two bounces. Red if (tried): the light-vertex estimator starts rays from the place of a directional
// light.
TEST(DirectionalLight, IndirectLightIsThatOfAFarLamp) {
  const Rendering render(room(), 12, 9);
  const Light sun = directional(slant, {3.0f, 2.0f, 1.0f});
  for (const Estimator estimator : {Estimator::next_event, Estimator::light_vertex})
    expect_equal_light(render, lighting({sun}), {lighting({far_omni(sun, 3000.0f)})}, estimator);
}

// Six lights, so that next-event estimation chooses one by power, and the light-vertex estimator starts at
// the three that have a place. Red if (each tried): directional lights are left out of the choice, or their
// probability is not divided by, or light vertices are chosen among all six.
TEST(DirectionalLight, MixesWithManyOtherLights) {
  const Rendering render(room(), 12, 9);
  const Light suns[] = {directional(slant, {1.0f, 0.5f, 0.2f}),
                        directional(glm::normalize(glm::vec3(-0.5f, -0.6f, -1.0f)), {0.2f, 0.2f, 0.9f}),
                        directional(glm::normalize(glm::vec3(0.1f, 0.3f, -1.0f)), {0.0f, 0.7f, 0.1f})};
  LightingState a =
      lighting({omni({0.3f, 0.6f, 0.4f}, glm::vec3(0.2f)), omni({-0.4f, 0.7f, 0.6f}, glm::vec3(0.1f)),
                spot({0.2f, 0.9f, 0.3f}, {0.3f, -1.0f, 0.1f}, 20.0f, 35.0f, glm::vec3(0.5f))});
  const LightingState others = a;
  LightingState far;
  for (const Light& sun : suns) {
    a.lights.insert(a.lights.begin(), sun);
    far.lights.push_back(far_omni(sun, 3000.0f));
  }
  for (const Estimator estimator : {Estimator::next_event, Estimator::light_vertex})
    expect_equal_light(render, a, {others, far}, estimator);
}

}  // namespace
}  // namespace relight::tiny
