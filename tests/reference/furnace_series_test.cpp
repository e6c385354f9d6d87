// The geometric series of radiance in closed rooms, term by term, up to an albedo of 0.99. (furnace_test.cpp
// has the first four terms of low albedos exactly, and one sum.)
#include <cmath>

#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {
namespace {

// A closed box that shines with radiance 1 everywhere.
RadianceMeter furnace(double albedo) {
  Scene scene = tiny::empty_scene(glm::vec3(static_cast<float>(albedo)));
  scene.materials[0].emission = glm::vec3(1.0f);
  tiny::add_box(scene, {-1, -1, -1}, {1, 2, 1.5f});
  finish_scene(scene);
  return RadianceMeter(std::move(scene), {});
}

const glm::vec3 eye(0.3f, 0.2f, 0.4f), wall(-1.0f, 0.1f, -0.8f);

// k bounces bring albedo^(k+1). The error allowed is half of what one bounce too many or too few would
// change. Red if: a bounce is dropped or counted twice, a surface or Russian roulette (from the fifth bounce
// on) loses or makes light, at any length of path. Tried: roulette without its division; roulette that
// survives 1 % too often; throughput x 1.02; bounces counted from the next vertex.
void expect_terms(double albedo, int last, const Effort& effort) {
  const RadianceMeter meter = furnace(albedo);
  for (int k = 0; k <= last; ++k) {
    SCOPED_TRACE(testing::Message() << k << " bounces");
    const double expected = std::pow(static_cast<double>(static_cast<float>(albedo)), k + 1);
    // Emitters found by BRDF rays alone: without noise in a furnace. SumOf300BouncesAtAlbedo99 samples them.
    Effort quiet = effort;
    quiet.sample_extended_lights = false;
    const Reading reading = meter.read(eye, wall, {k, k, true}, quiet);
    expect_reads(reading, glm::dvec3(expected), 0.0, 0.5 * (1.0 / albedo - albedo));
  }
}

TEST(FurnaceSeries, EveryTermAtAlbedo50) { expect_terms(0.5, 8, {256, 24}); }
TEST(FurnaceSeries, EveryTermAtAlbedo90) { expect_terms(0.9, 12, {256, 24}); }
TEST(FurnaceSeries, EveryTermAtAlbedo99) { expect_terms(0.99, 12, {128, 24}); }

// The sum up to 300 bounces at 0.99 is 95.2 % of the full series: long paths hold most of its light. Red if:
// paths end early, or light is lost a little at every bounce (tried: throughput x 0.9995).
TEST(FurnaceSeries, SumOf300BouncesAtAlbedo99) {
  const double rho = 0.99f;
  const double expected = rho * (1.0 - std::pow(rho, 301)) / (1.0 - rho);
  const Reading reading = furnace(0.99).read(eye, wall, {0, 300, true}, {128, 24});
  // Rounding of the throughput adds up over 100 bounces.
  expect_reads(reading, glm::dvec3(expected), 1e-5 * expected, 0.02);
}

// Area-weighted and extreme irradiance of a sphere's facets from an omni light of intensity 1 in its centre.
struct Facets {
  double least = 1e30, most = 0.0;
  explicit Facets(const Scene& scene) {
    for (const Triangle& t : scene.triangles) {
      const glm::dvec3 a(scene.positions[t.v[0]]), b(scene.positions[t.v[1]]), c(scene.positions[t.v[2]]);
      const double plane = std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
      const double far = std::max({glm::length(a), glm::length(b), glm::length(c)});
      least = std::min(least, plane / std::pow(far, 3)), most = std::max(most, 1.0 / (plane * plane));
    }
  }
};

// Flat facets, so that no light is lost between shading and geometric normals.
Scene flat_sphere(double albedo, uint32_t n) {
  Scene smooth = tiny::empty_scene(), scene = tiny::empty_scene(glm::vec3(static_cast<float>(albedo)));
  tiny::add_sphere(smooth, glm::vec3(0.0f), 1.0f, n);
  for (size_t t = 0; t < smooth.triangles.size(); ++t) {
    const glm::vec3 normal = glm::normalize(smooth.area_normal(t));
    uint32_t v[3];
    for (int i = 0; i < 3; ++i)
      v[i] = tiny::add_vertex(scene, smooth.positions[smooth.triangles[t].v[i]], normal);
    tiny::add_triangle(scene, v[0], v[1], v[2]);
  }
  finish_scene(scene);
  return scene;
}

// An integrating sphere: a point light in the middle gives every facet nearly the same irradiance E, so k
// bounces bring albedo^(k+1) E / pi. As every point sees only the sphere, the light of the darkest and of the
// brightest facet bound the answer. Red if: next-event estimation or light vertices count a bounce wrongly or
// lack a factor (tried: next-event estimation without 1/pi, light vertices x 1.02, the second bounce
// dropped).
void expect_integrating_sphere(double albedo, const Effort& effort) {
  Scene scene = flat_sphere(albedo, 96);
  const Facets facets(scene);
  const double middle = 0.5 * (facets.least + facets.most), half = 0.5 * (facets.most - facets.least);
  ASSERT_LT(half, 2e-3 * middle);
  const RadianceMeter meter(std::move(scene), tiny::lighting({tiny::omni(glm::vec3(0.0f))}));
  for (int k : {1, 2, 3, 4, 5, 7}) {
    SCOPED_TRACE(testing::Message() << k << " bounces");
    const double scale = std::pow(static_cast<double>(static_cast<float>(albedo)), k + 1) / M_PI;
    const Reading reading = meter.read({0.1f, 0.2f, 0.1f}, {0.5f, -0.6f, 0.7f}, {k, k}, effort);
    expect_reads(reading, glm::dvec3(scale * middle), scale * half, 0.01 + 0.25 * (1.0 / albedo - albedo));
  }
}

TEST(IntegratingSphere, EveryTermByNextEvent) {
  for (double albedo : {0.5, 0.9, 0.99}) expect_integrating_sphere(albedo, {64, 24});
}
TEST(IntegratingSphere, EveryTermByLightVertices) {
  for (double albedo : {0.5, 0.99}) expect_integrating_sphere(albedo, {64, 24, Estimator::light_vertex});
}

}  // namespace
}  // namespace relight::check
