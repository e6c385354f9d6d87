// A convex body in an environment: what it reflects depends on nothing but its normal.
#include <cmath>

#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {
namespace {

constexpr double albedo = 0.75;

Scene sphere(const Environment& environment) {
  Scene scene = tiny::empty_scene(glm::vec3(static_cast<float>(albedo)));
  tiny::add_sphere(scene, glm::vec3(0.3f, -0.2f, 0.1f), 0.7f, 24);
  scene.environment = environment;
  finish_scene(scene);
  return scene;
}

// A place on the sphere where both normals are known exactly: the centroid of a triangle.
struct Place {
  glm::dvec3 point, shading, geometric;
  // Share of the cosine-weighted directions about the shading normal that lie behind the surface itself:
  // these are black by convention. (1 - cos) / 2 for an angle between the normals.
  double lost() const { return 0.5 * (1.0 - glm::dot(shading, geometric)); }
};

Place place_on(const Scene& scene, size_t t) {
  Place place{glm::dvec3(0.0), glm::dvec3(0.0), glm::normalize(glm::dvec3(scene.area_normal(t)))};
  for (uint32_t v : scene.triangles[t].v) {
    place.point += glm::dvec3(scene.positions[v]) / 3.0;
    place.shading += glm::dvec3(scene.normals[v]);
  }
  place.shading = glm::normalize(place.shading);
  if (glm::dot(place.shading, place.geometric) < 0.0) place.geometric = -place.geometric;
  return place;
}

// Calls expect(place, reading) at places from pole to pole, each seen from a slant.
template <typename Expect>
void read_places(const RadianceMeter& meter, const Effort& effort, Expect expect) {
  const Scene& scene = meter.scene();
  for (size_t t = 5; t < scene.triangles.size(); t += 211) {
    const Place place = place_on(scene, t);
    const glm::dvec3 slant = glm::normalize(place.shading + glm::dvec3(0.4, 0.5, -0.3));
    SCOPED_TRACE(testing::Message() << "normal " << place.shading.x << " " << place.shading.y << " "
                                    << place.shading.z);
    expect(place, meter.read(glm::vec3(place.point + 2.0 * slant), glm::vec3(place.point),
                             {0, 0, false, true}, effort));
  }
}

// Radiance L from everywhere gives albedo L. Red if: light is lost at grazing angles or on the side of the
// shading normal, a surface hides itself, or the environment counts twice. Tried: throughput x 1.02, the ray
// offset towards the inside, misses counted one bounce later, light that comes from behind the facet but not
// from behind its shading normal counted.
TEST(SphereInEnvironment, UniformLightIsReflectedByTheAlbedo) {
  Environment uniform;
  uniform.radiance = {2.0f, 1.0f, 0.5f};
  const RadianceMeter meter(sphere(uniform), {});
  read_places(meter, {16, 24}, [&](const Place& place, const Reading& reading) {
    const glm::dvec3 expected = albedo * glm::dvec3(uniform.radiance);
    expect_reads(reading, expected, 2.0 * albedo * place.lost(), 0.005);
  });
  const Reading later = meter.read({0.3f, -0.2f, 3.0f}, {0.3f, -0.2f, 0.1f}, {1, 4, false, true}, {16, 24});
  EXPECT_EQ(later.mean.x, 0.0) << "a convex body has no second bounce";
}

// Radiance 1 + 0.8 cos(w, axis) gives irradiance pi (1 + 0.8 2/3 cos(n, axis)). The map has 256 x 128 texels;
// halfway between its texels linear interpolation is off by less than the half of (pi/128)^2 / 4.
// Red if: the map is mirrored, turned the wrong way, shifted by a texel, or the cosine is lost. Tried: the
// sign of rotation_y, u mirrored, the map shifted by two texels, the cosine dropped from the throughput.
TEST(SphereInEnvironment, ALinearSkyIsReflectedByTwoThirdsOfItsSlope) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.7, 0.4, -0.6));
  Environment sky;
  sky.radiance = glm::vec3(1.0f);
  sky.rotation_y = 0.9f;
  sky.width = 256, sky.height = 128;
  for (int i = 0; i < sky.width * sky.height; ++i) {
    // The direction of the texel before the map is turned; turning moves azimuth phi to phi - rotation_y.
    const double azimuth = 2.0 * M_PI * ((i % 256 + 0.5) / 256 - 0.5) - static_cast<double>(sky.rotation_y);
    const double polar = M_PI * (i / 256 + 0.5) / 128;
    const glm::dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                       -std::sin(polar) * std::cos(azimuth));
    sky.texels.emplace_back(static_cast<float>(1.0 + 0.8 * glm::dot(d, axis)));
  }
  const double interpolation = 0.8 * std::pow(M_PI / 128, 2) / 8.0 * 2.0;
  read_places(RadianceMeter(sphere(sky), {}), {64, 24}, [&](const Place& place, const Reading& reading) {
    const double expected = albedo * (1.0 + 0.8 * 2.0 / 3.0 * glm::dot(place.shading, axis));
    expect_reads(reading, glm::dvec3(expected), albedo * (interpolation + 1.8 * place.lost()), 0.01);
  });
}

}  // namespace
}  // namespace relight::check
