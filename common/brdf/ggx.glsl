// Anisotropic microfacet reflection with the GGX (Trowbridge-Reitz) distribution and height-correlated Smith masking:
// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014. One scattering only: rough metals lose
// energy. Directions in the surface's frame (u, v, n).
#ifndef RELIGHT_GGX
#define RELIGHT_GGX

// Heitz 2014 equation 85, as 1/(pi au av (x^2/au^2 + y^2/av^2 + z^2)^2): no tangent, nothing cancels.
RL_FUNCTION float ggx_distribution(BrdfParams brdf, vec3 h) {
  float au = brdf.exponent, av = brdf.shape.exponent_v;
  float x = h.x / au, y = h.y / av;
  float q = x * x + y * y + h.z * h.z;
  return 1.0f / (rl_pi * au * av * q * q);
}

// w.z (1 + 2 Lambda(w)), Lambda from Heitz 2014 equations 72 and 86; at least the smaller alpha for a unit w.
RL_FUNCTION float ggx_stretched_length(BrdfParams brdf, vec3 w) {
  float x = brdf.exponent * w.x, y = brdf.shape.exponent_v * w.y;
  return sqrt(x * x + y * y + w.z * w.z);
}

// D F G2/(4 o.z i.z) with G2 = 1/(1 + Lambda(o) + Lambda(i)) (Heitz 2014 equation 99); the cosines cancel.
RL_FUNCTION vec3 ggx_eval(BrdfParams brdf, vec3 o, vec3 i) {
  if (!(o.z > 0.0f) || !(i.z > 0.0f)) return vec3(0.0f);
  vec4 h = brdf_half_vector(o, i);
  float masking = o.z * ggx_stretched_length(brdf, i) + i.z * ggx_stretched_length(brdf, o);
  // Both directions on the horizon to 1e-20 or so.
  if (!(h.z > 0.0f) || !(masking > 1e-20f)) return vec3(0.0f);
  return brdf_fresnel(brdf, h.w) * (0.5f * ggx_distribution(brdf, vec3(h)) / masking);
}

// Density of the visible normals (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018,
// equation 3) over 4 o.h: D G1(o)/(4 o.z), and G1(o)/o.z = 2/(o.z + stretched length). Facets may reflect below the
// surface: the density counts that.
RL_FUNCTION float ggx_pdf(BrdfParams brdf, vec3 o, vec3 i) {
  vec4 h = brdf_half_vector(o, i);
  if (!(o.z > 0.0f) || !(h.z > 0.0f)) return 0.0f;
  return 0.5f * ggx_distribution(brdf, vec3(h)) / (o.z + ggx_stretched_length(brdf, o));
}

// Spherical caps: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, listing 3, with the
// height t below the pole as the variable, so that neither 1 - z^2 nor the sum of the two heights cancels.
RL_FUNCTION vec3 ggx_sample(BrdfParams brdf, vec3 o, vec2 u) {
  float au = brdf.exponent, av = brdf.shape.exponent_v;
  vec3 s = normalize(vec3(au * o.x, av * o.y, o.z));
  float t = u.x * (1.0f + s.z);
  float r = sqrt(max(t * (2.0f - t), 0.0f));
  float phi = 2.0f * rl_pi * u.y;
  vec3 h = vec3(au * (s.x + r * cos(phi)), av * (s.y + r * sin(phi)), max((1.0f - u.x) * (1.0f + s.z), 0.0f));
  float squared = dot(h, h);
  h = squared > 0.0f ? h * (1.0f / sqrt(squared)) : vec3(0.0f, 0.0f, 1.0f);
  return h * (2.0f * dot(o, h)) - o;
}

#endif
