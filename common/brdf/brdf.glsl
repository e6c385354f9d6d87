// Reflection models, one source for C++ (GLM) and GLSL; see common/glsl_in_cpp.h for the subset.
// f_r = k_d/pi + one glossy part: Phong, Ashikhmin-Shirley, Lafortune or GGX. All are reciprocal, and reflect no more
// than arrives if k_d + glossy <= 1 (Lafortune: see largest_albedo in brdf_lobes.h).
#ifndef RELIGHT_BRDF
#define RELIGHT_BRDF

#include "common/brdf/brdf_params.glsl"
#include "common/brdf/power_cosine.glsl"
#include "common/brdf/phong.glsl"
#include "common/brdf/ashikhmin_shirley.glsl"
#include "common/brdf/lafortune.glsl"
#include "common/brdf/ggx.glsl"

RL_FUNCTION vec3 brdf_diffuse(BrdfParams brdf) { return brdf.diffuse * (1.0f / rl_pi); }

// Value of the glossy part [1/sr]; n, wo, wi unit and on the same side. From or towards below n all models but Phong
// give 0.
RL_FUNCTION vec3 brdf_glossy(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  uint model = brdf_model(brdf.shape);
  if (model == brdf_phong) return phong_eval(brdf, n, wo, wi);
  mat3 frame = brdf_frame(brdf.shape, n);
  vec3 o = brdf_to_local(frame, wo), i = brdf_to_local(frame, wi);
  if (model == brdf_ashikhmin_shirley) return ashikhmin_shirley_eval(brdf, o, i);
  if (model == brdf_lafortune) return lafortune_eval(brdf, o, i);
  return ggx_eval(brdf, o, i);
}

RL_FUNCTION vec3 brdf_eval(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  vec3 f = brdf_diffuse(brdf);
  if (brdf.glossy.x + brdf.glossy.y + brdf.glossy.z > 0.0f) f = f + brdf_glossy(brdf, n, wo, wi);
  return f;
}

#endif
