#include "common/brdf/brdf.h"

#include <cmath>

namespace relight {

namespace {

float diffuse_pdf(const glm::vec3& n, const glm::vec3& wi) {
  return glm::max(0.0f, glm::dot(n, wi)) * (1.0f / shader::rl_pi);
}

}  // namespace

glm::mat3 frame_around(const glm::vec3& n) { return shader::frame_with_sign(n, std::copysign(1.0f, n.z)); }

glm::vec3 sample_cosine(const glm::vec3& n, const glm::vec2& u) { return shader::brdf_cosine_sample(n, u); }

// With no glossy part the mixture is its diffuse part, to the last bit: what most surfaces of most scenes
// are, for a fraction of the work.
BrdfSample sample_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, float u_lobe,
                       const glm::vec2& u, bool diffuse_only) {
  if (!diffuse_only && brdf.glossy != glm::vec3(0.0f)) {
    const glm::vec4 sample = shader::brdf_mixture_sample(brdf, n, wo, u_lobe, u);
    return {glm::vec3(sample), sample.w};
  }
  if (!(shader::brdf_mean(brdf.diffuse) > 0.0f)) return {};
  const glm::vec3 wi = glm::normalize(shader::brdf_cosine_sample(n, u));
  return {wi, diffuse_pdf(n, wi)};
}

float brdf_pdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, const glm::vec3& wi,
               bool diffuse_only) {
  if (!diffuse_only && brdf.glossy != glm::vec3(0.0f)) return shader::brdf_mixture_pdf(brdf, n, wo, wi);
  return shader::brdf_mean(brdf.diffuse) > 0.0f ? diffuse_pdf(n, wi) : 0.0f;
}

}  // namespace relight
