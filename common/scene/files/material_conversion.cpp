#include "common/scene/files/material_conversion.h"

#include <algorithm>
#include <cmath>

namespace relight {

float phong_exponent_from_roughness(float roughness) {
  constexpr double largest = 1e5;  // a lobe of 0.3 degrees: a mirror at any resolution relight renders
  const double alpha = double(roughness) * double(roughness);
  if (!(alpha > 0.0)) return float(largest);
  return static_cast<float>(std::clamp(2.0 / (alpha * alpha) - 2.0, 0.0, largest));
}

bool lets_light_straight_through(const FileMaterial& material) { return material.opacity <= 0.0f; }

Material convert_material(const FileMaterial& file) {
  Material material;
  material.name = file.name;
  material.emission = file.emission;
  const float metal = std::clamp(file.metallic, 0.0f, 1.0f);
  glm::vec3 diffuse = file.base;
  // Some exporters write Kd 0 beside a texture; multiplied, the texture would be lost.
  if (file.has_texture && diffuse == glm::vec3(0.0f) && metal == 0.0f) diffuse = glm::vec3(1.0f);
  if (file.specular_from_base) {
    const float roughness = file.roughness >= 0.0f ? file.roughness : 1.0f;  // glTF's default
    const float alpha = roughness * roughness;
    material.diffuse = diffuse * (1.0f - metal);
    material.set_glossy_part(ggx_part(glm::mix(glm::vec3(0.04f), diffuse, metal), alpha, alpha));
    return material;
  }
  material.diffuse = metal >= 1.0f ? glm::vec3(0.0f) : diffuse;
  material.glossy = file.specular;
  if (material.is_glossy())
    material.exponent = file.roughness >= 0.0f ? phong_exponent_from_roughness(file.roughness)
                                               : std::clamp(file.phong_exponent, 0.0f, 1e5f);
  return material;
}

float srgb_to_linear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 srgb_to_linear(const glm::vec3& encoded) {
  return {srgb_to_linear(encoded.x), srgb_to_linear(encoded.y), srgb_to_linear(encoded.z)};
}

}  // namespace relight
