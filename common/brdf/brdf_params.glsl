// What a reflection model is made of, and what all models share; part of brdf.glsl.
#ifndef RELIGHT_BRDF_PARAMS
#define RELIGHT_BRDF_PARAMS

RL_CONST float rl_pi = 3.14159265358979323846f;

// Models of the glossy part.
RL_CONST uint brdf_phong = 0u;
RL_CONST uint brdf_ashikhmin_shirley = 1u;
RL_CONST uint brdf_lafortune = 2u;
RL_CONST uint brdf_ggx = 3u;

// The glossy part beyond its colour and first exponent: 32 bytes, because every sample of a view carries one. All
// zero: an isotropic Phong lobe. Made by the functions of brdf_lobes.h.
struct BrdfShape {
  float tangent;     // angle [rad] about n from the first axis of brdf_base_frame(n) to the surface's u axis
  float exponent_v;  // Ashikhmin-Shirley: n_v; GGX: alpha_v; Lafortune: exponent of the second lobe
  float exponent_w;  // Lafortune: exponent of the third lobe
  uint ratios_0, ratios_1, ratios_2;  // Lafortune: (C_x / C_z, C_y / C_z) of each lobe as two halves
  // Lafortune: shares of the first and the second lobe in `glossy`, 10 bits a channel (red lowest); what is left is
  // the third lobe's. The two highest bits of the first word hold the model.
  uint shares_0_model, shares_1;
};

struct BrdfParams {
  vec3 diffuse;    // Lambert albedo k_d, whatever the model
  float exponent;  // Phong exponent; Ashikhmin-Shirley: n_u; GGX: alpha_u; Lafortune: exponent of the first lobe
  vec3 glossy;     // Phong, Lafortune: albedo at normal incidence; others: F0. Black: no glossy part
  BrdfShape shape;
};

RL_FUNCTION uint brdf_model(BrdfShape shape) { return shape.shares_0_model >> 30u; }

// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017: no cancellation near -z. Columns (x, y, n);
// `sign` is 1 or -1 and has the sign of n.z.
RL_FUNCTION mat3 frame_with_sign(vec3 n, float sign_z) {
  float a = -1.0f / (sign_z + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0f + sign_z * n.x * n.x * a, sign_z * b, -sign_z * n.x),
              vec3(b, sign_z + n.y * n.y * a, -n.y), n);
}

// By comparison: the frame that tangents refer to must not depend on whether a GPU keeps the sign of -0.
RL_FUNCTION mat3 brdf_base_frame(vec3 n) { return frame_with_sign(n, n.z < 0.0f ? -1.0f : 1.0f); }

// Columns (u, v, n) of the surface's own frame.
RL_FUNCTION mat3 brdf_frame(BrdfShape shape, vec3 n) {
  mat3 base = brdf_base_frame(n);
  if (shape.tangent == 0.0f) return base;
  float c = cos(shape.tangent), s = sin(shape.tangent);
  return mat3(base[0] * c + base[1] * s, base[1] * c - base[0] * s, n);
}

RL_FUNCTION vec3 brdf_to_local(mat3 frame, vec3 w) {
  return vec3(dot(frame[0], w), dot(frame[1], w), dot(frame[2], w));
}

RL_FUNCTION float brdf_mean(vec3 c) { return (c.x + c.y + c.z) * (1.0f / 3.0f); }

// Unit vector half-way between the unit vectors a and b, and its cosine to either; 0 if they are opposite. The cosine
// from the length of the sum: symmetric in a and b to the last bit, and exact where a product would cancel.
RL_FUNCTION vec4 brdf_half_vector(vec3 a, vec3 b) {
  vec3 sum = a + b;
  float squared = dot(sum, sum);
  // Below 1e-15 long, a sum of unit vectors is all rounding.
  if (!(squared > 1e-30f)) return vec4(0.0f);
  float length_of_sum = sqrt(squared);
  return vec4(sum * (1.0f / length_of_sum), 0.5f * length_of_sum);
}

// Schlick's approximation, Computer Graphics Forum 13(3), 1994, equation 15, but rising from F0 = glossy to
// 1 - k_d instead of 1: the diffuse part stays Lambert at all angles (transport methods count on it), so the lobe
// may reflect no more than the diffuse part leaves over. `cosine` between half vector and either direction.
RL_FUNCTION vec3 brdf_fresnel(BrdfParams brdf, float cosine) {
  float m = clamp(1.0f - cosine, 0.0f, 1.0f);
  float m2 = m * m;
  vec3 rise = max(vec3(1.0f) - brdf.diffuse - brdf.glossy, vec3(0.0f));
  return brdf.glossy + rise * (m2 * m2 * m);
}

#endif
