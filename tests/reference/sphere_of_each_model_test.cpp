// A sphere of each reflection model in a uniform environment, against quadrature of the same model in double.
// tests/brdf checks the models; this checks that the path tracer integrates them: densities, frames, the
// split into lobes, the horizon.
#include <array>
#include <cmath>
#include <numbers>

#include "common/brdf/brdf_lobes.h"
#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {
namespace {

Scene sphere(const Material& material) {
  Scene scene = tiny::empty_scene();
  scene.materials[0] = material;
  tiny::add_sphere(scene, glm::vec3(0.0f), 1.0f, 24);
  scene.environment.radiance = glm::vec3(1.0f, 2.0f, 0.5f);
  finish_scene(scene);
  return scene;
}

Material with_part(const GlossyPart& part) {
  Material material;
  material.diffuse = glm::vec3(0.2f);
  material.set_glossy_part(part);
  return material;
}

// Share of uniform light that is reflected towards wo; nothing arrives from below the geometric normal.
double reflected_share(const Material& material, const glm::vec3& shading, const glm::vec3& geometric,
                       const glm::vec3& wo) {
  const shader::BrdfParams brdf{material.diffuse, material.exponent, material.glossy, material.shape};
  const glm::mat3 frame = frame_around(shading);
  const int rows = 500, columns = 700;
  double sum = 0.0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double z = (i + 0.5) / rows, r = std::sqrt(1.0 - z * z);
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / columns;
      const glm::vec3 wi = frame * glm::vec3(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
      if (glm::dot(wi, geometric) > 0.0f)
        sum += z * static_cast<double>(shader::brdf_eval(brdf, shading, wo, wi).x);
    }
  return sum * 2.0 * std::numbers::pi / (rows * columns);
}

// Places from the middle of the picture to its rim, seen from one side.
void expect_sphere(const Material& material) {
  const RadianceMeter meter(sphere(material), {});
  const Scene& scene = meter.scene();
  const glm::vec3 eye(0.0f, 0.0f, 6.0f);
  int seen = 0;
  for (size_t t = 0; t < scene.triangles.size() && seen < 4; t += 41) {
    glm::vec3 point(0.0f), shading(0.0f);
    for (uint32_t v : scene.triangles[t].v) point += scene.positions[v] / 3.0f, shading += scene.normals[v];
    shading = glm::normalize(glm::dot(shading, point) < 0.0f ? -shading : shading);  // outwards
    glm::vec3 geometric = glm::normalize(scene.area_normal(t));
    if (glm::dot(geometric, shading) < 0.0f) geometric = -geometric;
    const glm::vec3 wo = glm::normalize(eye - point);
    if (glm::dot(geometric, wo) < 0.15f) continue;
    SCOPED_TRACE(testing::Message() << "triangle " << t << ", cosine " << glm::dot(shading, wo));
    ++seen;
    const double share = reflected_share(material, shading, geometric, wo);
    Effort effort{512, 24};
    const Reading reading =
        meter.read(eye, point, {.first = 0, .last = 0, .environment = true, .glossy = true}, effort);
    // The quadrature's steps of 1/500 give the narrowest lobes here an error below 0.2 %; the camera's cone,
    // 0.01 degrees wide, less.
    expect_reads(reading, share * glm::dvec3(1.0, 2.0, 0.5), 0.004 * share, 0.05);
  }
  EXPECT_EQ(seen, 4);
}

// Red if (each tried): the density is that of another model, the lobe's share of samples is left out of it, a
// lobe is not counted at the eye, or the glossy part is 5 % too bright.
TEST(SphereOfEachModel, Lambert) {
  Material material;
  material.diffuse = glm::vec3(0.7f);
  expect_sphere(material);
}
TEST(SphereOfEachModel, Phong) { expect_sphere(with_part(phong_part(glm::vec3(0.6f), 40.0f))); }
TEST(SphereOfEachModel, AshikhminShirley) {
  expect_sphere(with_part(ashikhmin_shirley_part(glm::vec3(0.5f), 10.0f, 100.0f)));
}
TEST(SphereOfEachModel, Ggx) { expect_sphere(with_part(ggx_part(glm::vec3(0.6f), 0.2f, 0.2f))); }
TEST(SphereOfEachModel, AnisotropicGgx) { expect_sphere(with_part(ggx_part(glm::vec3(0.6f), 0.1f, 0.5f))); }
TEST(SphereOfEachModel, Lafortune) {
  const std::array<LafortuneLobe, 2> lobes{LafortuneLobe{-1.0f, -1.0f, 0.9f, 20.0f, glm::vec3(0.3f)},
                                           LafortuneLobe{0.4f, 0.4f, 0.6f, 4.0f, glm::vec3(0.2f)}};
  expect_sphere(with_part(lafortune_part(lobes)));
}

}  // namespace
}  // namespace relight::check
