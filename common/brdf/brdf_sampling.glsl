// Sampling of the models in brdf.glsl: a mixture of cosine-weighted directions and the glossy part's own distribution.
// Glossy samples may fall below n: the density counts them (it integrates to 1 over the whole sphere), callers drop
// them because no light arrives from there.
#ifndef RELIGHT_BRDF_SAMPLING
#define RELIGHT_BRDF_SAMPLING

#include "common/brdf/brdf.glsl"

// Estimate of the glossy part's albedo for wo, to choose between it and the diffuse part.
RL_FUNCTION float brdf_glossy_importance(BrdfParams brdf, vec3 n, vec3 wo) {
  uint model = brdf_model(brdf.shape);
  float glossy = brdf_mean(brdf.glossy);
  if (model == brdf_phong || !(glossy > 0.0f)) return glossy;
  float cosine = dot(n, wo);
  if (!(cosine > 0.0f)) return 0.0f;
  if (model == brdf_lafortune)
    return lafortune_total_importance(brdf, brdf_to_local(brdf_frame(brdf.shape, n), wo));
  return brdf_mean(brdf_fresnel(brdf, cosine));
}

// Probability of sampling the glossy part, or a negative number if nothing is reflected.
RL_FUNCTION float brdf_glossy_probability(BrdfParams brdf, vec3 n, vec3 wo) {
  float diffuse = brdf_mean(brdf.diffuse), glossy = brdf_glossy_importance(brdf, n, wo);
  float sum = diffuse + glossy;
  return sum > 0.0f ? glossy / sum : -1.0f;
}

// Density of the glossy part's distribution [1/sr]. Only where brdf_glossy_probability is positive.
RL_FUNCTION float brdf_glossy_pdf(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  uint model = brdf_model(brdf.shape);
  if (model == brdf_phong) return phong_pdf(brdf, n, wo, wi);
  mat3 frame = brdf_frame(brdf.shape, n);
  vec3 o = brdf_to_local(frame, wo), i = brdf_to_local(frame, wi);
  if (model == brdf_ashikhmin_shirley) return ashikhmin_shirley_pdf(brdf, o, i);
  if (model == brdf_lafortune) return lafortune_pdf(brdf, o, i, lafortune_total_importance(brdf, o));
  return ggx_pdf(brdf, o, i);
}

// u_lobe in [0,1) chooses among the lobes of the glossy part.
RL_FUNCTION vec3 brdf_glossy_sample(BrdfParams brdf, vec3 n, vec3 wo, float u_lobe, vec2 u) {
  uint model = brdf_model(brdf.shape);
  if (model == brdf_phong) return phong_sample(brdf, n, wo, u);
  mat3 frame = brdf_frame(brdf.shape, n);
  vec3 o = brdf_to_local(frame, wo);
  if (model == brdf_ashikhmin_shirley) return frame * ashikhmin_shirley_sample(brdf, o, u);
  if (model == brdf_lafortune)
    return frame * lafortune_sample(brdf, o, lafortune_total_importance(brdf, o), u_lobe, u);
  return frame * ggx_sample(brdf, o, u);
}

RL_FUNCTION vec3 brdf_cosine_sample(vec3 n, vec2 u) {
  float radius = sqrt(u.x), phi = 2.0f * rl_pi * u.y;
  float z = sqrt(max(0.0f, 1.0f - u.x));
  mat3 frame = frame_with_sign(n, floatBitsToInt(n.z) < 0 ? -1.0f : 1.0f);
  return frame * vec3(radius * cos(phi), radius * sin(phi), z);
}

// Density of the mixture [1/sr] over all directions.
RL_FUNCTION float brdf_mixture_pdf(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  float glossy = brdf_glossy_probability(brdf, n, wo);
  if (glossy < 0.0f) return 0.0f;
  float pdf = (1.0f - glossy) * max(0.0f, dot(n, wi)) * (1.0f / rl_pi);
  if (glossy > 0.0f) pdf = pdf + glossy * brdf_glossy_pdf(brdf, n, wo, wi);
  return pdf;
}

// Direction of the mixture and its density; all 0 if nothing is reflected.
RL_FUNCTION vec4 brdf_mixture_sample(BrdfParams brdf, vec3 n, vec3 wo, float u_lobe, vec2 u) {
  float glossy = brdf_glossy_probability(brdf, n, wo);
  if (glossy < 0.0f) return vec4(0.0f);
  vec3 wi = u_lobe < glossy ? brdf_glossy_sample(brdf, n, wo, u_lobe / glossy, u) : brdf_cosine_sample(n, u);
  wi = normalize(wi);
  return vec4(wi, brdf_mixture_pdf(brdf, n, wo, wi));
}

#endif
