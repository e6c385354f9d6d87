// Normalised Phong lobe: glossy (n+2)/(2 pi) cos^n(alpha), alpha between wi and the mirror direction of wo (Lafortune
// and Willems 1994, "Using the modified Phong reflectance model for physically based rendering", equation 5). The
// factor makes the lobe's albedo at normal incidence equal to `glossy`; at other angles the horizon cuts some off.
#ifndef RELIGHT_PHONG
#define RELIGHT_PHONG

RL_FUNCTION vec3 phong_mirror(vec3 n, vec3 w) { return n * (2.0f * dot(n, w)) - w; }

RL_FUNCTION vec3 phong_eval(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  float c = dot(phong_mirror(n, wo), wi);
  if (!(c > 0.0f)) return vec3(0.0f);
  return brdf.glossy * ((brdf.exponent + 2.0f) / (2.0f * rl_pi) * pow(c, brdf.exponent));
}

RL_FUNCTION float phong_pdf(BrdfParams brdf, vec3 n, vec3 wo, vec3 wi) {
  return power_cosine_pdf(dot(phong_mirror(n, wo), wi), brdf.exponent);
}

RL_FUNCTION vec3 phong_sample(BrdfParams brdf, vec3 n, vec3 wo, vec2 u) {
  return sample_power_cosine(phong_mirror(n, wo), brdf.exponent, u);
}

#endif
