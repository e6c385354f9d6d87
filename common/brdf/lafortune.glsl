// Up to three generalised cosine lobes: Lafortune, Foo, Torrance and Greenberg, "Non-Linear Approximation of
// Reflectance Functions", SIGGRAPH 1997, equation 7, rho (C_x u_x v_x + C_y u_y v_y + C_z u_z v_z)^n. Here each lobe is
// divided by C_z^n and normalised like Phong, so that its weight is its albedo at normal incidence:
//   weight (n+2)/(2 pi) (r_x u_x v_x + r_y u_y v_y + u_z v_z)^n,  r = C / C_z.
// r = -1 is the Phong lobe. Directions in the surface's frame (u, v, n).
#ifndef RELIGHT_LAFORTUNE
#define RELIGHT_LAFORTUNE

RL_CONST int lafortune_lobes = 3;

RL_FUNCTION float lafortune_exponent(BrdfParams brdf, int lobe) {
  return lobe == 0 ? brdf.exponent : lobe == 1 ? brdf.shape.exponent_v : brdf.shape.exponent_w;
}

RL_FUNCTION vec3 lafortune_weight(BrdfParams brdf, int lobe) {
  uint a = brdf.shape.shares_0_model, b = brdf.shape.shares_1;
  vec3 first = vec3(float(a & 1023u), float((a >> 10u) & 1023u), float((a >> 20u) & 1023u));
  vec3 second = vec3(float(b & 1023u), float((b >> 10u) & 1023u), float((b >> 20u) & 1023u));
  vec3 share = lobe == 0 ? first : lobe == 1 ? second : max(vec3(1023.0f) - first - second, vec3(0.0f));
  return brdf.glossy * (share * (1.0f / 1023.0f));
}

// The lobe's axis, not of unit length: the value of the lobe is a power of its product with the other direction.
RL_FUNCTION vec3 lafortune_axis(BrdfParams brdf, int lobe, vec3 o) {
  uint bits = lobe == 0 ? brdf.shape.ratios_0 : lobe == 1 ? brdf.shape.ratios_1 : brdf.shape.ratios_2;
  vec2 ratios = unpackHalf2x16(bits);
  return vec3(ratios.x * o.x, ratios.y * o.y, o.z);
}

RL_FUNCTION vec3 lafortune_eval(BrdfParams brdf, vec3 o, vec3 i) {
  vec3 f = vec3(0.0f);
  if (!(o.z > 0.0f) || !(i.z > 0.0f)) return f;
  for (int lobe = 0; lobe < lafortune_lobes; ++lobe) {
    float n = lafortune_exponent(brdf, lobe);
    float c = dot(lafortune_axis(brdf, lobe, o), i);
    if (c > 0.0f) f = f + lafortune_weight(brdf, lobe) * ((n + 2.0f) / (2.0f * rl_pi) * pow(c, n));
  }
  return f;
}

// Albedo that the lobe is expected to have for o, to choose lobes by: its weight, less what it loses because its axis
// is shorter than 1.
RL_FUNCTION float lafortune_importance(BrdfParams brdf, int lobe, vec3 o) {
  float weight = brdf_mean(lafortune_weight(brdf, lobe));
  vec3 axis = lafortune_axis(brdf, lobe, o);
  float squared = dot(axis, axis);
  if (!(weight > 0.0f) || !(squared > 1e-30f)) return 0.0f;
  return squared >= 1.0f ? weight : weight * pow(squared, 0.5f * lafortune_exponent(brdf, lobe));
}

RL_FUNCTION float lafortune_total_importance(BrdfParams brdf, vec3 o) {
  return lafortune_importance(brdf, 0, o) + lafortune_importance(brdf, 1, o) + lafortune_importance(brdf, 2, o);
}

// `total` > 0 is lafortune_total_importance(brdf, o).
RL_FUNCTION float lafortune_pdf(BrdfParams brdf, vec3 o, vec3 i, float total) {
  float pdf = 0.0f;
  for (int lobe = 0; lobe < lafortune_lobes; ++lobe) {
    float importance = lafortune_importance(brdf, lobe, o);
    if (!(importance > 0.0f)) continue;
    float cosine = dot(normalize(lafortune_axis(brdf, lobe, o)), i);
    pdf = pdf + importance / total * power_cosine_pdf(cosine, lafortune_exponent(brdf, lobe));
  }
  return pdf;
}

// u_lobe in [0,1) chooses the lobe.
RL_FUNCTION vec3 lafortune_sample(BrdfParams brdf, vec3 o, float total, float u_lobe, vec2 u) {
  float left = u_lobe * total;
  int chosen = 0;
  for (int lobe = 0; lobe < lafortune_lobes; ++lobe) {
    float importance = lafortune_importance(brdf, lobe, o);
    if (!(importance > 0.0f)) continue;
    chosen = lobe;  // rounding may leave a rest behind the last lobe: it is the last one's
    if (left < importance) break;
    left = left - importance;
  }
  return sample_power_cosine(normalize(lafortune_axis(brdf, chosen, o)), lafortune_exponent(brdf, chosen), u);
}

#endif
