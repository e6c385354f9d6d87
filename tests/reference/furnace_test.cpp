// Scenes whose radiance is known without computing anything.
#include <cmath>

#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

Rendering furnace(float albedo, float emission) {
  Scene scene = empty_scene(glm::vec3(albedo));
  scene.materials[0].emission = glm::vec3(emission, 0.5f * emission, 0.0f);
  add_box(scene, {-1, -1, -1}, {1, 2, 1.5f});
  scene.camera = {{0.3f, 0.2f, 0.4f}, {-1, 0.1f, -0.8f}, {0, 1, 0}, 80.0f};
  finish_scene(scene);
  return Rendering(std::move(scene), 6, 4);
}

LightPaths emitted(int min, int max) {
  LightPaths paths = bounces(min, max);
  paths.emission = true;
  return paths;
}

// Inside a closed box every surface shows Le (1 + rho + rho^2 + ...); k bounces of indirect light are
// rho^(k+1). Red if (each tried): bounces are counted from the wrong vertex, a cosine or pi is lost, or one
// ray in a hundred leaks.
TEST(ClosedBox, EachBounceOfEmittedLightHasItsPowerOfTheAlbedo) {
  for (float rho : {0.2f, 0.8f}) {
    const Rendering render = furnace(rho, 3.0f);
    for (int k = 0; k <= 3; ++k) {
      PathTracerSettings s = settings(Estimator::next_event, 8, 2, emitted(k, k));
      s.sample_extended_lights = false;  // no noise: every path gives the same
      const PathTracerResult result = render({}, s);
      for (const glm::vec3& p : result.indirect.pixels) {
        EXPECT_NEAR(p.x, 3.0 * std::pow(rho, k + 1), 1e-4) << "rho " << rho << " k " << k;
        EXPECT_NEAR(p.y, 1.5 * std::pow(rho, k + 1), 1e-4);
        EXPECT_EQ(p.z, 0.0f);
      }
      for (const glm::vec3& p : result.direct.pixels) EXPECT_EQ(p.x, 3.0f);
      EXPECT_EQ(result.non_finite, 0);
    }
  }
}

// Red if (both tried): Russian roulette isn't compensated, or stops paths of high albedo early.
TEST(ClosedBox, ManyBouncesOfHighAlbedoGiveTheTruncatedGeometricSeries) {
  const double rho = 0.95;
  const Rendering render = furnace(static_cast<float>(rho), 1.0f);
  const int most = 40;
  const PathTracerResult result = render({}, settings(Estimator::light_vertex, 4096, 64, emitted(0, most)));
  const double expected = rho * (1.0 - std::pow(rho, most + 1)) / (1.0 - rho);
  glm::dvec3 variance =
      mean_of(result.indirect_variance) / static_cast<double>(result.indirect.pixels.size());
  EXPECT_NEAR(mean_of(result.indirect).x, expected, 4.0 * std::sqrt(variance.x));
  EXPECT_LT(std::sqrt(variance.x), 0.01 * expected);
}

Rendering plate(const Material& material, const glm::vec3& eye) {
  Scene scene = empty_scene();
  scene.materials[0] = material;
  scene.environment.radiance = glm::vec3(2.0f, 1.0f, 0.0f);
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  scene.camera = {eye, {0, 0, 0}, {0, 1, 0}, 1.0f};
  finish_scene(scene);
  return Rendering(std::move(scene), 4, 4);
}

LightPaths environment(bool glossy) {
  LightPaths paths = bounces(0, 0, glossy);
  paths.environment = true;
  return paths;
}

// Red if (each tried): the environment is missed, counted twice, or bounce 0 is off by one.
TEST(WhiteFurnace, ALambertPlateReflectsItsAlbedoExactly) {
  Material material;
  material.diffuse = glm::vec3(0.6f);
  const Rendering render = plate(material, {0, 0.5f, 3});
  const PathTracerResult result = render({}, settings(Estimator::next_event, 16, 2, environment(false)));
  for (const glm::vec3& p : result.indirect.pixels) {
    EXPECT_NEAR(p.x, 1.2f, 1e-5f);
    EXPECT_NEAR(p.y, 0.6f, 1e-5f);
  }
  // With 1..1 bounces there is nothing: the plate is convex.
  LightPaths later = environment(false);
  later.min_bounces = later.max_bounces = 1;
  for (const glm::vec3& p : render({}, settings(Estimator::next_event, 16, 2, later)).indirect.pixels)
    EXPECT_EQ(p, glm::vec3(0.0f));
}

// Directional albedo of the glossy lobe by quadrature in double.
double lobe_albedo(double exponent, double cosine) {
  const int rows = 4000, columns = 720;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double z = (i + 0.5) / rows, phi = 2.0 * M_PI * (j + 0.5) / columns, r = std::sqrt(1.0 - z * z);
      const double alpha = -sine * r * std::cos(phi) + cosine * z;  // with wo = (sine, 0, cosine)
      if (alpha > 0.0) sum += (exponent + 2.0) / (2.0 * M_PI) * std::pow(alpha, exponent) * z;
    }
  return sum * 2.0 * M_PI / (rows * columns);
}

// Red if (both tried): the lobe's normalisation is off by one, or its share is left out of the mixture
// density. (Light from below the horizon never arrives: the plate is in its way.)
TEST(WhiteFurnace, AGlossyPlateReflectsItsDirectionalAlbedoAndNoMore) {
  for (float exponent : {0.0f, 5.0f, 100.0f})
    for (double degrees : {0.0, 50.0, 80.0}) {
      const double a = glm::radians(degrees);
      Material material;
      material.diffuse = glm::vec3(0.3f), material.glossy = glm::vec3(0.7f), material.exponent = exponent;
      const Rendering render = plate(material, glm::vec3(0.0f, 8.0 * std::sin(a), 8.0 * std::cos(a)));
      const PathTracerResult result =
          render({}, settings(Estimator::next_event, 4096, 16, environment(true)));
      const double found = mean_of(result.indirect).y;
      const double error = std::sqrt(mean_of(result.indirect_variance).y / 16.0);
      // The camera's cone of 1 degree averages over angles; 0.001 bounds its effect.
      EXPECT_NEAR(found, 0.3 + 0.7 * lobe_albedo(exponent, std::cos(a)), 5.0 * error + 0.001)
          << "exponent " << exponent << " at " << degrees << " degrees";
      EXPECT_LE(found, 1.0 + 5.0 * error);
    }
}

// Red if (both tried): the flags of LightPaths don't switch the lobe off, or each switches the other vertex.
TEST(LightPathFlags, AForbiddenLobeNeitherReflectsNorIsSampled) {
  Material material;
  material.diffuse = glm::vec3(0.3f), material.glossy = glm::vec3(0.7f), material.exponent = 20.0f;
  const Rendering render = plate(material, {0, 0.5f, 3});
  LightPaths later = environment(false);
  later.glossy_interior = true;  // the plate is the visible surface: nothing changes
  for (const LightPaths& paths : {environment(false), later})
    for (const glm::vec3& p : render({}, settings(Estimator::next_event, 16, 2, paths)).indirect.pixels)
      EXPECT_NEAR(p.y, 0.3f, 1e-5f);
  LightPaths here = environment(false);
  here.glossy_at_eye = true;
  EXPECT_GT(mean_of(render({}, settings(Estimator::next_event, 16, 2, here)).indirect).y, 0.8);
}

// Red if (both tried): emission that the camera sees ignores its flag, or the environment is missing.
TEST(DirectImage, HoldsEmissionAndEnvironmentOnlyWhereTheyCount) {
  Material material;
  material.diffuse = glm::vec3(0.0f);  // what it would reflect is direct light, too
  material.emission = glm::vec3(4.0f);
  Scene scene = empty_scene();
  scene.materials[0] = material;
  scene.environment.radiance = glm::vec3(2.0f);
  add_quad(scene, {-9, -9, 0}, {9, 0, 0}, {0, 18, 0});  // the left half of the picture
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40.0f};
  finish_scene(scene);
  const Rendering render(std::move(scene), 4, 1);
  LightPaths paths;
  EXPECT_EQ(mean_of(render({}, settings(Estimator::next_event, 2, 2, paths)).direct).x, 0.0);
  paths.emission = true;
  EXPECT_EQ(mean_of(render({}, settings(Estimator::next_event, 2, 2, paths)).direct).x, 2.0);
  paths.environment = true;
  EXPECT_EQ(mean_of(render({}, settings(Estimator::next_event, 2, 2, paths)).direct).x, 3.0);
}

}  // namespace
}  // namespace relight::tiny
