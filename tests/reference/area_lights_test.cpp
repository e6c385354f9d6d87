// Irradiance from rectangles, discs and shining meshes against closed forms, one reflection off the floor.
#include "tests/reference/area_shapes.h"

namespace relight::tiny {
namespace {

const glm::vec3 shine(3.0f, 2.0f, 1.0f);

// Above the floor and facing it; at a slant of its own plane; standing on the floor with one edge.
const check::Rectangle above{{-0.3, 0.7, -0.1}, {1.1, 0, 0}, {0, 0, 0.9}};
const check::Rectangle standing{{-0.4, 0, -0.5}, {0.9, 0, 0}, {0, 0.8, 0}};
const glm::dvec3 places[] = {{0.1, 0, 0.3}, {0.5, 0, -0.2}, {-0.2, 0, 0.02}};

glm::dvec3 reflected(double form_factor) { return floor_albedo * form_factor * glm::dvec3(shine); }

// Form factors of a point and a rectangle. Red if (tried): a ray's weight takes the density over the area
// for one over directions, or the light's cosine loses its sign.
TEST(RectangleLight, IrradianceIsItsFormFactor) {
  for (const check::Rectangle& r : {above, standing}) {
    const check::RadianceMeter meter(floor_scene(), lighting({rectangle_light(r, shine)}));
    for (const glm::dvec3& p : places) {
      SCOPED_TRACE(testing::Message() << p.x << " " << p.z);
      const double factor = check::form_factor(p, {0, 1, 0}, r);
      expect_reads(read_floor(meter, p), reflected(factor), 1e-4, 0.02);
    }
  }
}

// The same light from a rectangle and from two triangles that shine as brightly, each against the form
// factor. Red if (tried): points crowd at one corner of a triangle (no square root).
TEST(EmittingMesh, GivesTheLightOfARectangleOfItsShape) {
  for (const check::Rectangle& r : {above, standing}) {
    Scene scene = floor_scene();
    add_rectangle(scene, r, add_material(scene, black_material(shine)));
    finish_scene(scene);
    const check::RadianceMeter mesh(std::move(scene), {});
    const check::RadianceMeter shape(floor_scene(), lighting({rectangle_light(r, shine)}));
    for (const glm::dvec3& p : places) {
      const check::Reading a = read_floor(mesh, p), b = read_floor(shape, p);
      const double error = std::hypot(a.error.x, b.error.x);
      // 6 standard errors of 46 degrees of freedom: a false alarm in 3e6.
      EXPECT_LT(std::abs(a.mean.x - b.mean.x), 6.0 * error + 2e-4 * b.mean.x);
      expect_reads(a, reflected(check::form_factor(p, {0, 1, 0}, r)), 1e-4, 0.02);
    }
  }
}

// R^2 / (R^2 + d^2) on the axis. Red if (tried): the disc's area is that of its square.
TEST(DiscLight, IrradianceOnTheAxisIsTheClosedForm) {
  for (const double distance : {0.05, 0.6, 1.9}) {
    const double radius = 0.5;
    const check::RadianceMeter meter(
        floor_scene(), lighting({disc_light({0.3, distance, -0.2}, {0, -1, 0}, radius, shine)}));
    SCOPED_TRACE(distance);
    const double factor = radius * radius / (radius * radius + distance * distance);
    expect_reads(meter.read({0.6f, 0.04f, -0.2f}, {0.3f, 0, -0.2f}, {0, 0}, {256, 24}), reflected(factor),
                 1e-3, 0.02);
  }
}

// A tilted disc off the axis by a midpoint rule in polar coordinates. Red if (tried): points are
// drawn with half their angle on two of the four wedges of the disc.
TEST(DiscLight, IrradianceOfATiltedDiscIsItsIntegral) {
  const glm::dvec3 centre(0.3, 0.8, -0.1), axis = glm::normalize(glm::dvec3(-0.5, -1.0, 0.4));
  const double radius = 0.6;
  const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(1, 0, 0))), v = glm::cross(axis, u);
  const check::RadianceMeter meter(floor_scene(), lighting({disc_light(centre, axis, radius, shine)}));
  for (const glm::dvec3& p : places) {
    double factor = 0.0;
    const int n = 400;
    for (int i = 0; i < n * n; ++i) {
      const double r = radius * (i % n + 0.5) / n, phi = 2.0 * M_PI * (i / n + 0.5) / n;
      const glm::dvec3 d = centre + r * (std::cos(phi) * u + std::sin(phi) * v) - p;
      const double d2 = glm::dot(d, d), facing = -glm::dot(axis, d);
      factor += std::max(0.0, facing) * d.y / (d2 * d2) / M_PI * r * radius / n * 2.0 * M_PI / n;
    }
    expect_reads(read_floor(meter, p), reflected(factor), 1e-3, 0.02);
  }
}

// A sphere wholly above the horizon: (R/D)^2 times the cosine. The mesh lies inside the sphere by at most
// 1 - cos(pi/64) of R at its edges, and latitude bands likewise: its form factor is less by under 2 x that
// twice. Red if (tried): shadow rays are left out: the light's own body hides half of its points.
TEST(EmittingMesh, SphereShinesAsItsSquaredRadius) {
  Scene scene = floor_scene();
  const double radius = 0.3;
  const glm::dvec3 centre(0.2, 0.9, 0.1);
  add_sphere(scene, glm::vec3(centre), static_cast<float>(radius), 32,
             add_material(scene, black_material(shine)));
  finish_scene(scene);
  const check::RadianceMeter meter(std::move(scene), {});
  for (const glm::dvec3& p : places) {
    const glm::dvec3 d = centre - p;
    const double squared = glm::dot(d, d), factor = radius * radius / squared * d.y / std::sqrt(squared);
    const glm::dvec3 expected = reflected(factor);
    expect_reads(read_floor(meter, p, 512), expected, 4.0 * (1.0 - std::cos(M_PI / 64.0)) * expected, 0.03);
  }
}

// A row of one dim, one bright and one dark light: power decides how often each is asked, never how much it
// gives. Red if (both tried): the disc's area is that of its square, or the weight of a ray leaves out with
// which probability its light is chosen.
TEST(AreaLights, LightOfSeveralAddsUp) {
  const check::Rectangle far{{1.2, 0.5, -0.4}, {0.5, 0, 0}, {0, 0, 0.5}};
  Scene scene = floor_scene();
  add_rectangle(scene, far, add_material(scene, black_material(0.1f * shine)));
  finish_scene(scene);
  const check::RadianceMeter meter(
      std::move(scene), lighting({rectangle_light(above, shine), rectangle_light(standing, glm::vec3(0.0f)),
                                  disc_light({0.1, 1.5, 0.3}, {0, -1, 0}, 0.4, 5.0f * shine)}));
  const glm::dvec3 p(0.1, 0, 0.3), up(0, 1, 0);
  const double disc = 0.16 / (0.16 + 2.25);
  const double factor = check::form_factor(p, up, above) + 0.1 * check::form_factor(p, up, far) + 5.0 * disc;
  expect_reads(read_floor(meter, p, 512), reflected(factor), 1e-3, 0.02);
}

}  // namespace
}  // namespace relight::tiny
