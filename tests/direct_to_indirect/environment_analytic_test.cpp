// Light of the environment on surfaces where it is known in closed form.
#include <gtest/gtest.h>

#include "common/run/thread_limit.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "tests/direct_to_indirect/environment_setup.h"

namespace relight::direct_to_indirect {
namespace {

const glm::vec3 radiance(2.0f, 1.0f, 0.25f);

Environment even_sky() {
  Environment environment;
  environment.radiance = radiance;
  return environment;
}

// A floor of 20 x 20 at y = 0 seen from above, all over the picture.
Scene floor_scene() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0});
  scene.camera = {{0.3f, 3.0f, 2.0f}, {0.2f, 0.0f, 0.1f}, {0, 1, 0}, 30.0f};
  finish_scene(scene);
  return scene;
}

void expect_all(const std::vector<glm::dvec3>& light, const glm::dvec3& expected, double bound) {
  for (int c = 0; c < 3; ++c) {
    const Spread spread(light, c);
    EXPECT_NEAR(spread.lowest, expected[c], bound * expected[c]) << "channel " << c;
    EXPECT_NEAR(spread.highest, expected[c], bound * expected[c]) << "channel " << c;
  }
}

// Irradiance / pi = L, for view samples and gather samples alike. The cosine is summed at 16 directions a
// texel, midpoints in both coordinates: the error falls by four with the number of texels (2.4e-4 of 1024).
// One coefficient is enough for an even sky: it is the mean, and every row keeps it.
TEST(EnvironmentAnalytic, AnOpenPlaneUnderAnEvenSky) {
  const EnvironmentSetup plane(floor_scene(), 8, 8);
  for (const auto& [texels, bound] : {std::pair{1024, 3e-4}, {4096, 7.5e-5}})
    for (const int kept : {1, 100}) {
      const EnvironmentTransfer transfer = plane.transfer(environment_settings(texels, kept));
      for (const SparseRows* rows : {&transfer.view, &transfer.gather}) {
        for (size_t r = 0; r < rows->rows(); ++r) ASSERT_LE(rows->row(r).size(), static_cast<size_t>(kept));
        expect_all(plane.light(*rows, even_sky()), glm::dvec3(radiance), bound);
      }
      EXPECT_EQ(transfer.glossy.rows(), 0u);
    }
}

// The same with normals in all directions: no square of the sphere is special. Light from behind a facet is
// black by convention: (1 - cos) / 2 of it, half a per mille where the shading normal is 2.5 degrees off.
TEST(EnvironmentAnalytic, AConvexBodyUnderAnEvenSky) {
  Scene scene = tiny::empty_scene();
  tiny::add_sphere(scene, glm::vec3(0.0f), 1.0f, 36);
  scene.camera = {{2.0f, 1.5f, 2.5f}, {0, 0, 0}, {0, 1, 0}, 12.0f};
  finish_scene(scene);
  const EnvironmentSetup sphere(std::move(scene));
  for (const SurfaceSample& s : sphere.buffer.indirect) ASSERT_TRUE(s.valid);
  expect_all(sphere.light(sphere.transfer(environment_settings(1024, 100)).view, even_sky()),
             glm::dvec3(radiance), 2e-3);
}

// L(d) = max(0, d.y): irradiance 2 pi / 3 on a floor. With all coefficients exact but for the resolution of
// map and square. A hundred tell cells of some 16 x 16 on the square apart: what both cosines vary within one
// is lost, 2.4 % here, the more so as they vary alike.
TEST(EnvironmentAnalytic, ASkyLikeACosineGivesTwoThirdsOfItsZenith) {
  Environment sky = tiny::black_map(256, 128);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 256; ++x)
      sky.texels[static_cast<size_t>(256 * y + x)] =
          glm::vec3(static_cast<float>(std::cos(M_PI * (y + 0.5) / 128)));
  const EnvironmentSetup plane(floor_scene(), 8, 8);
  for (const auto& [kept, bound] : {std::pair{4096, 1e-3}, {100, 3e-2}})
    expect_all(plane.light(plane.transfer(environment_settings(4096, kept)).view, sky), glm::dvec3(2.0 / 3.0),
               bound);
}

// A wall, much larger than the distance to it, hides a half space: half of the irradiance at its foot. Along
// the axes the wall's edge is the square's; turned, the hundred texels that it crosses are seen or not by
// chance, each of 1 / 2000 of the light.
TEST(EnvironmentAnalytic, AWallHidesHalfOfTheSky) {
  for (const float degrees : {0.0f, 30.0f}) {
    Scene scene = floor_scene();
    const glm::vec3 along(std::sin(glm::radians(degrees)), 0.0f, std::cos(glm::radians(degrees)));
    const glm::vec3 across(along.z, 0.0f, -along.x);
    tiny::add_quad(scene, -2000.0f * along - 0.02f * across, 4000.0f * along, {0, 2000, 0});
    scene.camera = {{1.0f, 1.0f, 0.5f}, {0.1f, 0.0f, 0.1f}, {0, 1, 0}, 3.0f};
    finish_scene(scene);
    const EnvironmentSetup wall(std::move(scene), 16, 16);
    const Spread spread(wall.light(wall.transfer(environment_settings(4096, 100)).view, even_sky()), 0);
    const double expected = 0.5 * static_cast<double>(radiance.x);
    EXPECT_NEAR(spread.mean, expected, (degrees == 0.0f ? 2e-3 : 5e-3) * expected);
    EXPECT_NEAR(spread.lowest, expected, 0.03 * expected);
    EXPECT_NEAR(spread.highest, expected, 0.03 * expected);
  }
}

// One texel of the square lit at a time: only what is above the floor gives light, each in its column, and
// together as much as the cosine says. Red if a row's texels are not in tree order.
TEST(EnvironmentAnalytic, EachDirectionHasItsOwnColumn) {
  const EnvironmentSetup plane(floor_scene(), 4, 4);
  const EnvironmentTransfer transfer = plane.transfer(environment_settings(256, 256));
  const EnvironmentSquare square(256);
  double sum = 0.0;
  for (uint32_t t = 0; t < 256; ++t) {
    std::vector<glm::dvec3> one(256, glm::dvec3(0.0));
    one[t] = glm::dvec3(1.0);
    const auto found = static_cast<double>(multiply(transfer.view, wavelet::forward(one))[0].x);
    double cosine = 0.0;
    for (int k = 0; k < 64; ++k)
      cosine += std::max(0.0, square.direction(t, {(k % 8 + 0.5) / 8, (k / 8 + 0.5) / 8}).y) / 64.0;
    EXPECT_NEAR(found, cosine * square.solid_angle() / M_PI, 0.02 * square.solid_angle() / M_PI) << t;
    sum += found;
  }
  EXPECT_NEAR(sum, 1.0, 1e-3);
}

// A closed room sees no sky.
TEST(EnvironmentAnalytic, AClosedRoomIsBlackUnderAnySky) {
  Scene scene = tiny::empty_scene();
  tiny::add_box(scene, glm::vec3(-1.0f), glm::vec3(1.0f));
  scene.camera = {{0.5f, 0.2f, 0.7f}, {0, -0.3f, 0}, {0, 1, 0}, 60.0f};
  finish_scene(scene);
  const EnvironmentSetup room(std::move(scene));
  StageLog log;
  const EnvironmentTransfer transfer = room.transfer(environment_settings(1024, 100), log);
  EXPECT_EQ(transfer.view.entries.size() + transfer.gather.entries.size(), 0u);
  EXPECT_GT(log.counters().at("environment_rays"), 100000);
}

// A glossy plate under an even sky reflects the lobe's albedo: rays are drawn from the lobe, so that Phong's
// weights vary with the cosine only. 256 rays: 1 % of noise a pixel, less in the mean. Red if a lobe's colour
// counts twice.
TEST(EnvironmentAnalytic, AGlossyPlateReflectsItsLobesAlbedo) {
  Scene scene = floor_scene();
  scene.materials[0].glossy = glm::vec3(0.4f), scene.materials[0].exponent = 60.0f;
  finish_scene(scene);
  const EnvironmentSetup plate(std::move(scene), 12, 8);
  const EnvironmentTransfer transfer = plate.transfer(environment_settings(1024, 100));
  ASSERT_EQ(transfer.glossy.rows(), plate.buffer.indirect.size());
  const std::vector<glm::dvec3> light = plate.light(transfer.glossy, even_sky());
  double found = 0.0, expected = 0.0;
  for (size_t i = 0; i < light.size(); ++i) {
    const GlossyLobe lobe(plate.buffer.indirect[i], plate.scene.camera.eye);
    double albedo = 0.0;
    for (uint32_t k = 0; k < 4096; ++k)
      albedo += static_cast<double>(lobe.sample(0.5f, sobol_2d(k, 77 + i)).weight) / 4096.0;
    found += light[i].x / static_cast<double>(radiance.x), expected += albedo;
  }
  EXPECT_NEAR(found, expected, 2e-3 * expected);
}

// Same seed, same bits for any number of threads.
TEST(EnvironmentTransfer, DoesNotDependOnTheNumberOfThreads) {
  Scene scene = tiny::room(2.0f, glm::vec3(0.0f), true);
  const EnvironmentSetup room(std::move(scene));
  const auto bits = [&](int threads) {
    const ThreadLimit limit(threads);
    const EnvironmentTransfer t = room.transfer(environment_settings(256, 20));
    std::vector<float> values;
    for (const SparseRows* rows : {&t.view, &t.glossy, &t.gather})
      for (const SparseEntry& e : rows->entries) values.push_back(e.value), values.push_back(float(e.column));
    return values;
  };
  const std::vector<float> one = bits(1);
  EXPECT_GT(one.size(), 1000u);
  EXPECT_EQ(one, bits(2));
}

}  // namespace
}  // namespace relight::direct_to_indirect
