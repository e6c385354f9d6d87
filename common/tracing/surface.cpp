// From a hit to a surface sample: interpolation, two-sided normals, textures, tangents.
#include <cmath>

#include "common/tracing/ray_tracer.h"

namespace relight {

namespace {

// Unit geometric normal on the side from which `direction` arrives; in double, because edges of small
// triangles make cross products that underflow in float. A triangle without area faces the ray.
glm::vec3 facing_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                        const glm::vec3& direction) {
  const glm::dvec3 origin(a);
  glm::dvec3 n = glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
  const double length = glm::length(n);
  if (!(length > 0.0)) return -glm::normalize(direction);
  n /= length;
  return glm::vec3(glm::dot(n, glm::dvec3(direction)) > 0.0 ? -n : n);
}

// Interpolated normal on the side of ng; ng itself where interpolation gives none, or one in the surface's
// plane.
glm::vec3 shading_normal(const glm::vec3& sum, const glm::vec3& ng) {
  const float length = glm::length(sum);
  if (!(length > 0.0f)) return ng;
  const glm::vec3 n = sum / length;
  const float cosine = glm::dot(n, ng);
  if (cosine > 0.0f) return n;
  return cosine < 0.0f ? -n : ng;
}

// Angle about n, as BrdfShape has it, of the direction in which texture coordinate u grows over the triangle
// (constant over each triangle). 0, the frame's first axis, where the triangle has no such direction. Which
// way round the bitangent goes does not matter: every model is symmetric about the (u, n) plane.
float tangent_angle(const Scene& scene, const Triangle& triangle, const glm::vec3& n) {
  const auto [i, j, k] = triangle.v;
  const glm::dvec3 origin(scene.positions[i]);
  const glm::dvec3 a = glm::dvec3(scene.positions[j]) - origin, b = glm::dvec3(scene.positions[k]) - origin;
  const glm::dvec2 uv_a = glm::dvec2(scene.uvs[j]) - glm::dvec2(scene.uvs[i]);
  const glm::dvec2 uv_b = glm::dvec2(scene.uvs[k]) - glm::dvec2(scene.uvs[i]);
  const double determinant = uv_a.x * uv_b.y - uv_b.x * uv_a.y;
  if (determinant == 0.0 || !std::isfinite(determinant)) return 0.0f;
  const glm::dvec3 along_u = (uv_b.y * a - uv_a.y * b) / determinant;
  const glm::mat3 frame = shader::brdf_base_frame(n);
  const double x = glm::dot(glm::dvec3(frame[0]), along_u), y = glm::dot(glm::dvec3(frame[1]), along_u);
  const float angle = static_cast<float>(std::atan2(y, x));
  return std::isfinite(angle) ? angle : 0.0f;
}

// One return statement, so that the sample is made where the caller wants it: copying 128 bytes just written
// in smaller pieces stalls.
SurfaceSample surface_of(const Scene& scene, const Hit& hit, const glm::vec3& direction) {
  const Triangle& triangle = scene.triangles[hit.triangle];
  const auto [i, j, k] = triangle.v;
  const float w = 1.0f - hit.u - hit.v;
  const auto interpolate = [&](const auto& values) {
    return w * values[i] + hit.u * values[j] + hit.v * values[k];
  };
  const glm::vec3 geometric =
      facing_normal(scene.positions[i], scene.positions[j], scene.positions[k], direction);
  const Material& material = scene.materials[triangle.material];

  // Every field is given here: zeroing 128 bytes first costs as much as the interpolation.
  SurfaceSample sample{.position = interpolate(scene.positions),
                       .shading_normal = shading_normal(interpolate(scene.normals), geometric),
                       .geometric_normal = geometric,
                       .diffuse = material.diffuse,
                       .glossy = material.glossy,
                       .emission = material.emission,
                       .exponent = material.exponent,
                       .shape = material.shape,
                       .depth = 0.0f,
                       .triangle = hit.triangle,
                       .material = triangle.material,
                       .object = triangle.object,
                       .valid = true};
  if (material.diffuse_texture >= 0)
    sample.diffuse *=
        scene.textures[static_cast<size_t>(material.diffuse_texture)].sample(interpolate(scene.uvs));
  if (shader::brdf_model(material.shape) != shader::brdf_phong && material.glossy_part().anisotropic())
    sample.shape.tangent = tangent_angle(scene, triangle, sample.shading_normal);
  return sample;
}

}  // namespace

void RayTracer::prefetch_surface(const Hit& hit) const {
  if (!hit.valid) return;
  const Triangle& triangle = scene_.triangles[hit.triangle];
  const bool textured = scene_.materials[triangle.material].diffuse_texture >= 0;
  for (const uint32_t v : triangle.v) {
    __builtin_prefetch(&scene_.positions[v]);
    __builtin_prefetch(&scene_.normals[v]);
    if (textured) __builtin_prefetch(&scene_.uvs[v]);
  }
}

SurfaceSample RayTracer::surface(const Hit& hit, const glm::vec3& direction) const {
  return hit.valid ? surface_of(scene_, hit, direction) : SurfaceSample{};
}

}  // namespace relight
