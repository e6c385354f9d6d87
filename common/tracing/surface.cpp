// From a hit to a surface sample: interpolation, two-sided normals, textures.
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

}  // namespace

SurfaceSample RayTracer::surface(const Hit& hit, const glm::vec3& direction) const {
  SurfaceSample sample;
  if (!hit.valid) return sample;
  const Triangle& triangle = scene_.triangles[hit.triangle];
  const auto [i, j, k] = triangle.v;
  const float w = 1.0f - hit.u - hit.v;
  const auto interpolate = [&](const auto& values) {
    return w * values[i] + hit.u * values[j] + hit.v * values[k];
  };

  sample.position = interpolate(scene_.positions);
  sample.geometric_normal =
      facing_normal(scene_.positions[i], scene_.positions[j], scene_.positions[k], direction);
  sample.shading_normal = shading_normal(interpolate(scene_.normals), sample.geometric_normal);
  const Material& material = scene_.materials[triangle.material];
  sample.diffuse = material.diffuse;
  if (material.diffuse_texture >= 0)
    sample.diffuse *=
        scene_.textures[static_cast<size_t>(material.diffuse_texture)].sample(interpolate(scene_.uvs));
  sample.glossy = material.glossy;
  sample.exponent = material.exponent;
  sample.emission = material.emission;
  sample.triangle = hit.triangle;
  sample.material = triangle.material;
  sample.object = triangle.object;
  sample.valid = true;
  return sample;
}

}  // namespace relight
