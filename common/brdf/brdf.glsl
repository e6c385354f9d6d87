// Reflection models, one source for C++ (GLM) and GLSL; see common/glsl_in_cpp.h for the subset.
// f_r = diffuse/pi + glossy (n+2)/(2 pi) cos^n(alpha), alpha between wi and the mirror direction of wo
// (normalised Phong; the factor makes the lobe's albedo at normal incidence equal to `glossy`).
#ifndef RELIGHT_BRDF
#define RELIGHT_BRDF

RL_CONST float rl_pi = 3.14159265358979323846f;

struct BrdfParams {
  vec3 diffuse;    // Lambert albedo
  float exponent;  // Phong exponent
  vec3 glossy;     // albedo of the glossy lobe
};

RL_FUNCTION vec3 brdf_diffuse(BrdfParams brdf) { return brdf.diffuse * (1.0f / rl_pi); }

// Value of the glossy lobe [1/sr]; n, wo, wi unit and on the same side.
RL_FUNCTION vec3 brdf_glossy(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  vec3 mirror = n * (2.0f * dot(n, wo)) - wo;
  float c = dot(mirror, wi);
  if (!(c > 0.0f)) return vec3(0.0f);
  return brdf.glossy * ((brdf.exponent + 2.0f) / (2.0f * rl_pi) * pow(c, brdf.exponent));
}

RL_FUNCTION vec3 brdf_eval(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  vec3 f = brdf_diffuse(brdf);
  if (brdf.glossy.x + brdf.glossy.y + brdf.glossy.z > 0.0f) f = f + brdf_glossy(brdf, n, wo, wi);
  return f;
}

#endif
