// The tangent of anisotropic materials: along the u direction of the texture coordinates.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/tracing/ray_tracer.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// A square whose u axis is turned by `angle` about its normal, of a brushed metal (or another part).
Scene square(const glm::vec3& n, float angle, const GlossyPart& part, bool with_uvs = true) {
  Scene scene = tiny::empty_scene(glm::vec3(0.1f));
  scene.materials[0].set_glossy_part(part);
  const glm::mat3 base = shader::brdf_base_frame(n);
  const glm::vec3 u = base[0] * std::cos(angle) + base[1] * std::sin(angle);
  tiny::add_quad(scene, glm::vec3(0.0f), u, glm::cross(n, u));
  if (!with_uvs)
    for (glm::vec2& uv : scene.uvs) uv = glm::vec2(0.0f);
  finish_scene(scene);
  return scene;
}

SurfaceSample sample_of(const Scene& scene, uint32_t triangle, const glm::vec3& side) {
  const RayTracer tracer(scene);
  return tracer.surface({triangle, 1.0f, 0.3f, 0.3f, true}, -side);
}

const GlossyPart brushed = ggx_part(glm::vec3(0.5f), 0.05f, 0.3f);

// Red if the triangle's second edge or the normal's side turns the tangent (tried: uv_a and uv_b exchanged;
// the angle taken in frame_around of another normal).
TEST(Tangents, FollowTheTextureCoordinatesOnBothSidesAndBothTriangles) {
  for (const glm::vec3& n : {glm::vec3(0, 0, 1), glm::vec3(0, -1, 0), glm::normalize(glm::vec3(1, -2, -3))})
    for (float angle : {0.0f, 0.4f, 2.5f, -2.0f}) {
      const Scene scene = square(n, angle, brushed);
      const glm::mat3 base = shader::brdf_base_frame(n);
      const glm::vec3 u = base[0] * std::cos(angle) + base[1] * std::sin(angle);
      for (uint32_t triangle : {0u, 1u})
        for (float side : {1.0f, -1.0f}) {
          const SurfaceSample s = sample_of(scene, triangle, side * n);
          const glm::vec3 tangent = shader::brdf_frame(s.shape, s.shading_normal)[0];
          EXPECT_NEAR(glm::dot(tangent, u), 1.0f, 1e-5f)
              << n.x << ' ' << angle << ' ' << triangle << ' ' << side;
        }
    }
}

// Red if 0/0 for missing texture coordinates reaches the frame (tried).
TEST(Tangents, AreTheFramesOwnWithoutTextureCoordinates) {
  const SurfaceSample s = sample_of(square({0, 0, 1}, 1.0f, brushed, false), 0, {0, 0, 1});
  EXPECT_EQ(s.shape.tangent, 0.0f);
}

// Red if isotropic surfaces pay for tangents (tried), or their samples differ for a reason that no picture
// shows.
TEST(Tangents, AreLeftOutForIsotropicMaterials) {
  const LafortuneLobe lobe{-1, -1, 1, 10, glm::vec3(0.3f)};
  for (const GlossyPart& part : {phong_part(glm::vec3(0.5f), 10), ggx_part(glm::vec3(0.5f), 0.2f, 0.2f),
                                 ashikhmin_shirley_part(glm::vec3(0.5f), 9, 9), lafortune_part({&lobe, 1})})
    EXPECT_EQ(sample_of(square({0, 0, 1}, 1.0f, part), 0, {0, 0, 1}).shape.tangent, 0.0f);
}

// What the tangent is for: a highlight that is narrow along u and wide along v. Red if a step between texture
// coordinates and reflected light exchanges the axes (tried: along v instead of u).
TEST(Tangents, StretchTheHighlightAcrossTheBrushedDirection) {
  const float angle = pi / 3.0f;
  const glm::vec3 n(0, 0, 1), u(std::cos(angle), std::sin(angle), 0.0f), v = glm::cross(n, u);
  const SurfaceSample s = sample_of(square(n, angle, brushed), 0, n);
  const auto value = [&](const glm::vec3& towards) {
    return shader::brdf_eval(s.brdf(), s.shading_normal, n, glm::normalize(n + 0.3f * towards)).x;
  };
  EXPECT_GT(value(v), 5.0f * value(u));
}

}  // namespace
}  // namespace relight
