#include "common/brdf/brdf.h"

#include <algorithm>
#include <cmath>

namespace relight {

namespace {

constexpr float two_pi = 2.0f * shader::rl_pi;

float mean(const glm::vec3& c) { return (c.x + c.y + c.z) * (1.0f / 3.0f); }

// Probability of choosing the glossy lobe, or a negative number if no lobe reflects anything.
float glossy_probability(const shader::BrdfParams& brdf, bool diffuse_only) {
  const float diffuse = mean(brdf.diffuse), glossy = diffuse_only ? 0.0f : mean(brdf.glossy);
  const float sum = diffuse + glossy;
  return sum > 0.0f ? glossy / sum : -1.0f;
}

glm::vec3 mirror(const glm::vec3& n, const glm::vec3& w) { return n * (2.0f * glm::dot(n, w)) - w; }

// Direction with density (e+1)/(2 pi) cos^e around axis. cos = (1-u)^(1/(e+1)); its sine through expm1,
// because 1 - cos^2 cancels for large exponents.
glm::vec3 sample_power_cosine(const glm::vec3& axis, float exponent, const glm::vec2& u) {
  const double log_cosine = std::log1p(-static_cast<double>(u.x)) / (static_cast<double>(exponent) + 1.0);
  const float cosine = static_cast<float>(std::exp(log_cosine));
  const float sine = static_cast<float>(std::sqrt(std::max(0.0, -std::expm1(2.0 * log_cosine))));
  const float phi = two_pi * u.y;
  return frame_around(axis) * glm::vec3(sine * std::cos(phi), sine * std::sin(phi), cosine);
}

float power_cosine_pdf(float cosine, float exponent) {
  return cosine > 0.0f ? (exponent + 1.0f) / two_pi * std::pow(cosine, exponent) : 0.0f;
}

}  // namespace

// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017: no branch, no cancellation near -z.
glm::mat3 frame_around(const glm::vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  return {glm::vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x),
          glm::vec3(b, sign + n.y * n.y * a, -n.y), n};
}

glm::vec3 sample_cosine(const glm::vec3& n, const glm::vec2& u) {
  const float radius = std::sqrt(u.x), phi = two_pi * u.y;
  const float z = std::sqrt(std::max(0.0f, 1.0f - u.x));
  return frame_around(n) * glm::vec3(radius * std::cos(phi), radius * std::sin(phi), z);
}

BrdfSample sample_brdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, float u_lobe,
                       const glm::vec2& u, bool diffuse_only) {
  const float glossy = glossy_probability(brdf, diffuse_only);
  if (glossy < 0.0f) return {};
  BrdfSample sample;
  sample.wi = u_lobe < glossy ? sample_power_cosine(mirror(n, wo), brdf.exponent, u) : sample_cosine(n, u);
  sample.wi = glm::normalize(sample.wi);
  sample.pdf = brdf_pdf(brdf, n, wo, sample.wi, diffuse_only);
  return sample;
}

float brdf_pdf(const shader::BrdfParams& brdf, const glm::vec3& n, const glm::vec3& wo, const glm::vec3& wi,
               bool diffuse_only) {
  const float glossy = glossy_probability(brdf, diffuse_only);
  if (glossy < 0.0f) return 0.0f;
  float pdf = (1.0f - glossy) * std::max(0.0f, glm::dot(n, wi)) * (1.0f / shader::rl_pi);
  if (glossy > 0.0f) pdf += glossy * power_cosine_pdf(glm::dot(mirror(n, wo), wi), brdf.exponent);
  return pdf;
}

}  // namespace relight
