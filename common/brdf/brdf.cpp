#include "common/brdf/brdf.h"

#include <cmath>

namespace relight {

namespace {

// A black glossy part is no glossy part, for every model.
shader::BrdfParams without_glossy(shader::BrdfParams brdf) {
  brdf.glossy = glm::vec3(0.0f);
  return brdf;
}

}  // namespace

glm::mat3 frame_around(const glm::vec3& n) { return shader::frame_with_sign(n, std::copysign(1.0f, n.z)); }

glm::vec3 sample_cosine(const glm::vec3& n, const glm::vec2& u) { return shader::brdf_cosine_sample(n, u); }

BrdfSample sample_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, float u_lobe,
                       const glm::vec2& u, bool diffuse_only) {
  const glm::vec4 sample =
      shader::brdf_mixture_sample(diffuse_only ? without_glossy(brdf) : brdf, n, wo, u_lobe, u);
  return {glm::vec3(sample), sample.w};
}

float brdf_pdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, const glm::vec3& wi,
               bool diffuse_only) {
  return shader::brdf_mixture_pdf(diffuse_only ? without_glossy(brdf) : brdf, n, wo, wi);
}

}  // namespace relight
