// The glossy part of a view sample's reflection, split into a colour and a scalar lobe (Hasan 2006
// section 3.3, equations 4, 6 and 8): f_g(wi) = k_g rho_g(wi), so that F_g has one number an element and its
// rows don't depend on the colour.
//
// rho_g is the mean of the channels of brdf_glossy() over the mean of `glossy`. Phong, grey surfaces and
// Lafortune lobes of one colour are such a product exactly: k_g = glossy. Where the Fresnel term makes the
// colour change with the half vector (Ashikhmin-Shirley, GGX), or lobes differ in colour (Lafortune), k_g has
// the colour of the directional albedo towards the eye, found by sampling the lobe, and the mean of `glossy`:
// light of equal radiance from all sides is reflected in the right colour, and so is all light by a narrow
// lobe; a wide one is off by what its colour varies over it, at the same mean of channels. How much that is:
// tests/direct_to_indirect/glossy_lobe_test.cpp.
#pragma once

#include <cmath>
#include <vector>

#include <glm/glm.hpp>

#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/surface_sample.h"

namespace relight::direct_to_indirect {

inline bool is_glossy(const SurfaceSample& s) {
  return s.valid && s.glossy.x + s.glossy.y + s.glossy.z > 0.0f;
}

// rho_g of one view sample for light that leaves towards the eye.
class GlossyLobe {
 public:
  GlossyLobe() = default;
  // Of a sample that is_glossy.
  GlossyLobe(const SurfaceSample& sample, const glm::vec3& eye);

  // rho_g [1/sr]; wi unit, above the shading normal.
  float value(const glm::vec3& wi) const;
  // rho_g x cosine to the shading normal where the lobe is largest within the cone of half-angle b < 90
  // degrees about `axis` (unit): an estimate, taken in the cone's direction closest to the mirror direction.
  float largest_in_cone(const glm::vec3& axis, float cos_b, float sin_b) const;
  // About what the whole lobe reflects of even light: its directional albedo over the mean of `glossy`, with
  // the Fresnel term of a mirror. Above 1 where Fresnel makes a coat brighter than its F0.
  float albedo() const;
  // A direction from the lobe's own distribution, and rho_g x cosine / density of it; 0 if it is below the
  // shading normal or the density is 0. u_lobe in [0,1) chooses among several lobes.
  struct Sample {
    glm::vec3 wi;
    float weight;
  };
  Sample sample(float u_lobe, const glm::vec2& u) const;

 private:
  shader::BrdfParams brdf_{};
  glm::vec3 normal_{0.0f}, to_eye_{0.0f}, mirror_{0.0f};
  float per_mean_ = 0.0f;  // 1 / mean of the channels of `glossy`
};

// k_g of a sample that is_glossy. `number` selects the random numbers of the albedo's estimate.
glm::vec3 glossy_colour(const SurfaceSample& sample, const glm::vec3& eye, uint64_t number);

// The view's glossy pixels, ascending: index into buffer.indirect.
std::vector<uint32_t> glossy_pixels(const DeepFrameBuffer& buffer);
// k_g of each of them. Parallel, deterministic.
std::vector<glm::vec3> glossy_colours(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& pixels);

}  // namespace relight::direct_to_indirect
