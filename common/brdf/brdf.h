// C++ face of brdf.glsl, and sampling of the same models.
#pragma once

#include <glm/glm.hpp>

#include "common/glsl_in_cpp.h"

namespace relight {

namespace shader {
using namespace glm;
#include "common/brdf/brdf.glsl"
}  // namespace shader

// Orthonormal frame with z = n: columns (tangent, bitangent, n). n must be unit.
glm::mat3 frame_around(const glm::vec3& n);

// Cosine-weighted direction around n from u in [0,1)^2; pdf = cos/pi.
glm::vec3 sample_cosine(const glm::vec3& n, const glm::vec2& u);

struct BrdfSample {
  glm::vec3 wi{0.0f};  // unit
  float pdf = 0.0f;    // solid-angle density of wi under the mixture; 0 = no sample
};

// Samples wi from the mixture of the diffuse and glossy lobes (chosen by u_lobe in [0,1), weights by mean
// albedo). `diffuse_only` ignores the glossy lobe. The glossy lobe may give a wi below n: the density counts
// it (it integrates to 1 over the whole sphere), and callers drop it because no light arrives from there.
BrdfSample sample_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, float u_lobe,
                       const glm::vec2& u, bool diffuse_only);
// Density of sample_brdf for a given wi [1/sr].
float brdf_pdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, const glm::vec3& wi,
               bool diffuse_only);

}  // namespace relight
