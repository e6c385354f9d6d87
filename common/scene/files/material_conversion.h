// From the material models of mesh files to relight's: glTF to Lambert + GGX, MTL to Lambert + normalised
// Phong.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace relight {

// What a mesh file says about a surface, whatever its format.
struct FileMaterial {
  std::string name;
  glm::vec3 base{0.5f};             // diffuse colour (MTL Kd, glTF base colour)
  glm::vec3 specular{0.0f};         // MTL Ks: coat or conductor reflectance at normal incidence
  glm::vec3 emission{0.0f};         // MTL Ke
  float metallic = 0.0f;            // MTL Pm, glTF metallic factor
  float roughness = -1.0f;          // MTL Pr, glTF roughness: square root of the GGX alpha; < 0: not given
  float phong_exponent = 0.0f;      // MTL Ns, used where roughness is not given
  float opacity = 1.0f;             // MTL d
  bool has_texture = false;         // a diffuse texture exists (and was found)
  bool specular_from_base = false;  // glTF: 0.04 for dielectrics, the base colour for metals
};

// Phong exponent n whose lobe is about as wide as a GGX lobe of alpha = roughness^2: n = 2/alpha^2 - 2, the
// exponent of the Blinn-Phong distribution of equal slope variance (Walter et al. 2007, section 5.2). Clamped
// to [0, 1e5].
float phong_exponent_from_roughness(float roughness);

// Clear glass (MTL d 0, usually with illum 7), or anything else invisible. relight simulates no transmission.
bool lets_light_straight_through(const FileMaterial& material);

// Texture index and file are the caller's. Albedo is limited later, by repair_materials.
Material convert_material(const FileMaterial& material);

// Decodes an sRGB-encoded value in [0,1] to linear (IEC 61966-2-1).
float srgb_to_linear(float encoded);
glm::vec3 srgb_to_linear(const glm::vec3& encoded);

}  // namespace relight
