// C++ face of brdf.glsl and brdf_sampling.glsl.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

#include "common/glsl_in_cpp.h"

namespace relight {

namespace shader {
using namespace glm;

// (cosine, sine) of the angle to the axis of a power-cosine distribution: cos = (1-u)^(1/(e+1)); its sine
// through expm1, because 1 - cos^2 cancels for large exponents. GLSL has no double logarithms and uses series
// (power_cosine.glsl).
inline vec2 sample_power_cosine_angle(float u, float exponent) {
  const double log_cosine = std::log1p(-static_cast<double>(u)) / (static_cast<double>(exponent) + 1.0);
  return {static_cast<float>(std::exp(log_cosine)),
          static_cast<float>(std::sqrt(std::fmax(0.0, -std::expm1(2.0 * log_cosine))))};
}

#include "common/brdf/brdf_sampling.glsl"
}  // namespace shader

// Orthonormal frame with z = n: columns (tangent, bitangent, n). n must be unit.
glm::mat3 frame_around(const glm::vec3& n);

// Cosine-weighted direction around n from u in [0,1)^2; pdf = cos/pi.
glm::vec3 sample_cosine(const glm::vec3& n, const glm::vec2& u);

struct BrdfSample {
  glm::vec3 wi{0.0f};  // unit
  float pdf = 0.0f;    // solid-angle density of wi under the mixture; 0 = no sample
};

// Samples wi from the mixture of the diffuse and the glossy part (chosen by u_lobe in [0,1), weights by
// estimated albedo). `diffuse_only` ignores the glossy part. The glossy part may give a wi below n: the
// density counts it (it integrates to 1 over the whole sphere), and callers drop it because no light arrives
// from there.
BrdfSample sample_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, float u_lobe,
                       const glm::vec2& u, bool diffuse_only);
// Density of sample_brdf for a given wi [1/sr].
float brdf_pdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, const glm::vec3& wi,
               bool diffuse_only);

}  // namespace relight
