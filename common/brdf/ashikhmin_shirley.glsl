// Anisotropic Phong lobe of Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools 5(2),
// 2000. Directions in the surface's frame (u, v, n). Left out: the paper's coupled diffuse term (its equation 5); the
// diffuse part stays Lambert, see brdf_fresnel.
#ifndef RELIGHT_ASHIKHMIN_SHIRLEY
#define RELIGHT_ASHIKHMIN_SHIRLEY

// Density of the half vector h [1/sr], h.z >= 0: equation 6,
//   sqrt((nu+1)(nv+1))/(2 pi) (n.h)^((nu (h.u)^2 + nv (h.v)^2)/(1 - (h.n)^2)),
// written with 1 - (h.n)^2 = (h.u)^2 + (h.v)^2 and ln(h.n) = ln((h.n)^2)/2: nothing cancels as h nears n, and h = n is
// no special case.
RL_FUNCTION float ashikhmin_shirley_half_pdf(BrdfParams brdf, vec3 h) {
  float nu = brdf.exponent, nv = brdf.shape.exponent_v;
  float sine2 = min(h.x * h.x + h.y * h.y, 1.0f);
  float power = 0.5f * (nu * h.x * h.x + nv * h.y * h.y) * log_rest_over(sine2, h.z * h.z);
  return sqrt((nu + 1.0f) * (nv + 1.0f)) / (2.0f * rl_pi) * exp(power);
}

// Equation 4.
RL_FUNCTION vec3 ashikhmin_shirley_eval(BrdfParams brdf, vec3 o, vec3 i) {
  if (!(o.z > 0.0f) || !(i.z > 0.0f)) return vec3(0.0f);
  vec4 h = brdf_half_vector(o, i);
  float denominator = 4.0f * h.w * max(o.z, i.z);
  // Both directions within 1e-10 of the horizon, where h is rounding and f cos may overflow.
  if (!(denominator > 1e-20f)) return vec3(0.0f);
  return brdf_fresnel(brdf, h.w) * (ashikhmin_shirley_half_pdf(brdf, vec3(h)) / denominator);
}

// Equation 8. Half vectors seen from behind give directions below the surface: the density counts them.
RL_FUNCTION float ashikhmin_shirley_pdf(BrdfParams brdf, vec3 o, vec3 i) {
  vec4 h = brdf_half_vector(o, i);
  if (!(h.w > 1e-10f)) return 0.0f;
  return ashikhmin_shirley_half_pdf(brdf, vec3(h)) / (4.0f * h.w);
}

// Equations 9 and 10; the angle of all four quadrants at once.
RL_FUNCTION vec3 ashikhmin_shirley_sample(BrdfParams brdf, vec3 o, vec2 u) {
  float nu = brdf.exponent, nv = brdf.shape.exponent_v;
  float psi = 2.0f * rl_pi * u.y;
  vec2 phi = normalize(vec2(sqrt(nv + 1.0f) * cos(psi), sqrt(nu + 1.0f) * sin(psi)));
  vec2 theta = sample_power_cosine_angle(u.x, nu * phi.x * phi.x + nv * phi.y * phi.y);
  vec3 h = vec3(theta.y * phi.x, theta.y * phi.y, theta.x);
  return h * (2.0f * dot(o, h)) - o;
}

#endif
