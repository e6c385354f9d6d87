// Makes the glossy part of a material: one function a model, from its usual parameters to what brdf.glsl
// reads.
#pragma once

#include <span>

#include "common/brdf/brdf.h"

namespace relight {

enum class BrdfModel : uint32_t { phong = 0, ashikhmin_shirley = 1, lafortune = 2, ggx = 3 };

// Ranges that the tests cover and scene files accept.
constexpr float largest_exponent = 1e5f;  // a lobe of 0.3 degrees
constexpr float smallest_alpha = 1e-3f;   // GGX: narrower lobes are lost in float half vectors

struct GlossyPart {
  glm::vec3 glossy{0.0f};  // as in BrdfParams
  float exponent = 1.0f;
  shader::BrdfShape shape{};
  BrdfModel model() const { return static_cast<BrdfModel>(shader::brdf_model(shape)); }
  // True if turning the surface about its normal changes the reflection: a tangent is needed.
  bool anisotropic() const;
};

// Normalised Phong: albedo at normal incidence, exponent >= 0.
GlossyPart phong_part(const glm::vec3& albedo, float exponent);

// Ashikhmin-Shirley: reflectance at normal incidence F0, exponents >= 0 along u and v.
GlossyPart ashikhmin_shirley_part(const glm::vec3& f0, float exponent_u, float exponent_v);

// GGX: F0 and the roughness alpha along u and v; alphas are clamped to [smallest_alpha, 1].
GlossyPart ggx_part(const glm::vec3& f0, float alpha_u, float alpha_v);

// One generalised cosine lobe (lafortune.glsl). Phong is cx = cy = -1, cz = 1; |cx| > cz moves the peak away
// from the mirror direction towards the horizon, positive cx and cy send light back.
struct LafortuneLobe {
  float cx = -1.0f, cy = -1.0f, cz = 1.0f;  // cz > 0; |cx|, |cy| <= 8 cz
  float exponent = 1.0f;                    // >= 0
  glm::vec3 albedo{0.0f};                   // at normal incidence, >= 0
};

// Up to three lobes. What fits: cx/cz and cy/cz are rounded to half precision (11 bits), and each lobe's part
// in the total albedo to 1/1023 a channel, so that parts add up to the total. Lobes with coefficients that
// differ by colour channel, as fitted measurements have, need one lobe a channel: albedo (r,0,0), (0,g,0),
// (0,0,b). Throws std::invalid_argument on more lobes or values out of range.
GlossyPart lafortune_part(std::span<const LafortuneLobe> lobes);

// Largest directional albedo of the glossy part over all wo, per channel, or an upper bound of it. Phong: at
// normal incidence. Ashikhmin-Shirley, GGX: never above 1 - diffuse; F0 is returned, the least that they
// need. Lafortune: by quadrature, because lobes with |cx| > cz reflect more at grazing angles than at normal
// incidence.
glm::vec3 largest_albedo(const GlossyPart& part);

}  // namespace relight
