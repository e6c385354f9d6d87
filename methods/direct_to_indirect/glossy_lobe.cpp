#include "methods/direct_to_indirect/glossy_lobe.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x910551c0ull;

// Of the directional albedo. Only the ratio of its channels counts, which varies little over a lobe.
constexpr uint32_t colour_samples = 64;

bool grey(const glm::vec3& c) { return c.x == c.y && c.y == c.z; }

// True if the glossy part is k_g = `glossy` times a scalar.
bool separable(const SurfaceSample& s) {
  const uint32_t model = shader::brdf_model(s.shape);
  if (model == shader::brdf_phong) return true;
  // Only Fresnel's rise to 1 - k_d sees the diffuse albedo.
  return model != shader::brdf_lafortune && grey(s.glossy) && grey(s.diffuse);
}

}  // namespace

GlossyLobe::GlossyLobe(const SurfaceSample& sample, const glm::vec3& eye)
    : brdf_(sample.brdf()),
      normal_(sample.shading_normal),
      to_eye_(glm::normalize(eye - sample.position)),
      mirror_(shader::phong_mirror(normal_, to_eye_)),
      per_mean_(1.0f / shader::brdf_mean(sample.glossy)) {}

float GlossyLobe::value(const glm::vec3& wi) const {
  return shader::brdf_mean(shader::brdf_glossy(brdf_, normal_, to_eye_, wi)) * per_mean_;
}

float GlossyLobe::largest_in_cone(const glm::vec3& axis, float cos_b, float sin_b) const {
  const float along = glm::dot(axis, mirror_);
  glm::vec3 closest = mirror_;
  if (along < cos_b) {
    const glm::vec3 aside = mirror_ - along * axis;
    const float length2 = glm::dot(aside, aside);
    closest = length2 > 1e-12f ? axis * cos_b + aside * (sin_b / std::sqrt(length2)) : axis;
  }
  const float cosine = std::min(1.0f, glm::dot(normal_, closest) + sin_b);
  return cosine > 0.0f ? value(closest) * cosine : 0.0f;
}

float GlossyLobe::albedo() const {
  return shader::brdf_glossy_importance(brdf_, normal_, to_eye_) * per_mean_;
}

GlossyLobe::Sample GlossyLobe::sample(float u_lobe, const glm::vec2& u) const {
  if (!(shader::brdf_glossy_importance(brdf_, normal_, to_eye_) > 0.0f)) return {normal_, 0.0f};
  const glm::vec3 wi = glm::normalize(shader::brdf_glossy_sample(brdf_, normal_, to_eye_, u_lobe, u));
  const float cosine = glm::dot(normal_, wi);
  const float pdf = shader::brdf_glossy_pdf(brdf_, normal_, to_eye_, wi);
  if (!(cosine > 0.0f) || !(pdf > 0.0f)) return {wi, 0.0f};
  return {wi, value(wi) * cosine / pdf};
}

glm::vec3 glossy_colour(const SurfaceSample& s, const glm::vec3& eye, uint64_t number) {
  if (separable(s)) return s.glossy;
  const shader::BrdfParams brdf = s.brdf();
  const glm::vec3 n = s.shading_normal, wo = glm::normalize(eye - s.position);
  if (!(shader::brdf_glossy_importance(brdf, n, wo) > 0.0f)) return s.glossy;
  glm::vec3 albedo(0.0f);
  for (uint32_t k = 0; k < colour_samples; ++k) {
    const glm::vec2 u = sobol_2d(k, random_bits(0, stream, number, 0));
    const float u_lobe = (static_cast<float>(k) + 0.5f) / static_cast<float>(colour_samples);
    const glm::vec3 wi = glm::normalize(shader::brdf_glossy_sample(brdf, n, wo, u_lobe, u));
    const float cosine = glm::dot(n, wi), pdf = shader::brdf_glossy_pdf(brdf, n, wo, wi);
    if (cosine > 0.0f && pdf > 0.0f) albedo += shader::brdf_glossy(brdf, n, wo, wi) * (cosine / pdf);
  }
  const float mean = shader::brdf_mean(albedo);
  return mean > 0.0f && std::isfinite(mean) ? albedo * (shader::brdf_mean(s.glossy) / mean) : s.glossy;
}

std::vector<uint32_t> glossy_pixels(const DeepFrameBuffer& buffer) {
  std::vector<uint32_t> pixels;
  for (size_t i = 0; i < buffer.indirect.size(); ++i)
    if (is_glossy(buffer.indirect[i])) pixels.push_back(static_cast<uint32_t>(i));
  return pixels;
}

std::vector<glm::vec3> glossy_colours(const DeepFrameBuffer& buffer, const std::vector<uint32_t>& pixels) {
  std::vector<glm::vec3> colours(pixels.size());
  tbb::parallel_for(size_t{0}, pixels.size(), [&](size_t i) {
    colours[i] = glossy_colour(buffer.indirect[pixels[i]], buffer.view.camera.eye, pixels[i]);
  });
  return colours;
}

}  // namespace relight::direct_to_indirect
