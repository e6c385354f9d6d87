// Which sides of lights with an area shine, who sees them, and what stands in their way.
#include "tests/reference/area_shapes.h"
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

const glm::vec3 shine(2.0f);
const check::Rectangle down{{-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1}}, up{{-0.5, 1, -0.5}, {0, 0, 1}, {1, 0, 0}};
const glm::dvec3 origin(0.0), ahead(0, 1, 0);

check::Reading read(Scene scene, const LightingState& lights, const glm::dvec3& p = origin) {
  const check::RadianceMeter meter(std::move(scene), lights);
  return read_floor(meter, p);
}

glm::dvec3 reflected(double form_factor) { return floor_albedo * form_factor * glm::dvec3(shine); }

// Red if (each tried): the light's cosine is taken without its sign, by points drawn on it or by rays that
// meet it.
TEST(AreaLights, RectanglesAndDiscsShineFromOneSide) {
  EXPECT_EQ(read(floor_scene(), lighting({rectangle_light(up, shine)})).mean.x, 0.0);
  EXPECT_GT(read(floor_scene(), lighting({rectangle_light(down, shine)})).mean.x, 0.0);
  EXPECT_EQ(read(floor_scene(), lighting({disc_light({0, 1, 0}, ahead, 0.5, shine)})).mean.x, 0.0);
  EXPECT_GT(read(floor_scene(), lighting({disc_light({0, 1, 0}, -ahead, 0.5, shine)})).mean.x, 0.0);
}

// Red if (tried): triangles shine from the side of their normal only.
TEST(AreaLights, TrianglesShineFromBothSides) {
  const double factor = check::form_factor(origin, ahead, down);
  for (const check::Rectangle& r : {up, down}) {
    Scene scene = floor_scene();
    add_rectangle(scene, r, add_material(scene, black_material(shine)));
    finish_scene(scene);
    expect_reads(read(std::move(scene), {}), reflected(factor), 1e-4, 0.02);
  }
}

// A black sheet over x < 0 at half the height leaves, at the origin, the half of the light over x > 0. Red if
// (both tried): a shadow ray is left out, or rays meet shapes behind what they hit.
TEST(AreaLights, AreShadowed) {
  const check::Rectangle sheet{{-2, 0.5, -2}, {2, 0, 0}, {0, 0, 4}},
      half{{0, 1, -0.5}, {0.5, 0, 0}, {0, 0, 1}};
  const glm::dvec3 expected = reflected(check::form_factor(origin, ahead, half));
  Scene scene = floor_scene();
  add_rectangle(scene, sheet, add_material(scene, black_material()));
  finish_scene(scene);
  Scene with_mesh = scene;
  add_rectangle(with_mesh, down, add_material(with_mesh, black_material(shine)));
  finish_scene(with_mesh);
  expect_reads(read(scene, lighting({rectangle_light(down, shine)})), expected, 1e-3, 0.03);
  expect_reads(read(with_mesh, {}), expected, 1e-3, 0.03);
  const double disc = 0.5 * 0.25 / 1.25;
  expect_reads(read(scene, lighting({disc_light({0, 1, 0}, -ahead, 0.5, shine)})), reflected(disc), 1e-3,
               0.03);
}

// Red if (tried): rays stop at the first shape that they meet.
TEST(AreaLights, RectanglesAndDiscsBlockNothing) {
  const check::Rectangle behind{{-0.5, 1.5, -0.5}, {1, 0, 0}, {0, 0, 1}};
  const LightingState both = lighting({rectangle_light(down, shine), rectangle_light(behind, shine)});
  const double factor = check::form_factor(origin, ahead, down) + check::form_factor(origin, ahead, behind);
  expect_reads(read(floor_scene(), both), reflected(factor), 1e-3, 0.02);
}

// The camera looks straight into the light. Red if (both tried): the camera sees shapes, or shapes shadow
// delta lights.
TEST(AreaLights, ShapesAreNotSeenByTheCamera) {
  Scene scene = floor_scene();
  scene.camera = {{0.1f, 2.0f, 0.2f}, {0.1f, 0.0f, 0.2f}, {0, 0, 1}, 20.0f};
  const Rendering render(std::move(scene), 8, 6);
  const Light lamp = omni({0.0f, 1.5f, 0.0f});
  const LightPaths paths = bounces(1, 1);
  const PathTracerSettings s = settings(Estimator::next_event, 16, 2, paths);
  const PathTracerResult without = render(lighting({lamp}), s);
  const PathTracerResult with = render(lighting({lamp, rectangle_light(up, shine)}), s);
  for (size_t i = 0; i < with.direct.pixels.size(); ++i)
    EXPECT_EQ(with.direct.pixels[i], without.direct.pixels[i]);
  EXPECT_EQ(mean_of(with.indirect), glm::dvec3(0.0)) << "a plane does not light itself";
}

// A light built into a black ceiling, in the plane of the surface itself; tilted, so that its plane is not
// exact in float. Red if (tried): the shape is not lifted off the surface: rounding then hides half
// of its light.
TEST(AreaLights, ShineWhenTheyAreFlushWithASurface) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.1, -1.0, 0.23));
  const glm::dvec3 a = glm::normalize(glm::cross(n, glm::dvec3(0.2, 0.1, 1.0))), b = glm::cross(n, a);
  const glm::dvec3 centre(0.033, 0.917, -0.071);
  const check::Rectangle light{centre - 0.4 * a - 0.3 * b, 0.8 * a, 0.6 * b};
  const check::Rectangle ceiling{centre - 3.0 * a - 2.9 * b, 5.7 * a, 5.9 * b};
  Scene scene = floor_scene();
  add_rectangle(scene, ceiling, add_material(scene, black_material()));
  finish_scene(scene);
  for (const glm::dvec3& p : {origin, glm::dvec3(0.4, 0, 0.3)}) {
    expect_reads(read(scene, lighting({rectangle_light(light, shine)}), p),
                 reflected(check::form_factor(p, ahead, light)), 1e-3, 0.02);
  }
  const double radius = 0.35;
  const check::Reading with = read(scene, lighting({disc_light(centre, n, radius, shine)})),
                       without = read(floor_scene(), lighting({disc_light(centre, n, radius, shine)}));
  EXPECT_LT(std::abs(with.mean.x - without.mean.x), 6.0 * std::hypot(with.error.x, without.error.x));
}

}  // namespace
}  // namespace relight::tiny
