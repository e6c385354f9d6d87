// Light models, one source for C++ (GLM) and GLSL; see common/glsl_in_cpp.h for the subset.
// Omni: constant intensity. Spot: cosine-smoothstep between the inner and outer cone. Directional: parallel light.
// A light with an area is a sum of its points (emitter.h), each of which shines with the cosine to its normal.
#ifndef RELIGHT_LIGHT_MODELS
#define RELIGHT_LIGHT_MODELS

struct LightParams {
  vec4 position_type;     // xyz position [scene units]; w: 0 omni, 1 spot, 2 directional, -1 point of an area
  vec4 direction_outer;   // xyz unit axis; w: cosine of the outer half-angle
  vec4 intensity_inner;   // xyz intensity [W/sr], directional: irradiance [W/m^2]; w: cosine of the inner half-angle
};

// Intensity [W/sr] leaving the light along the unit direction `away`.
RL_FUNCTION vec3 light_intensity(LightParams light, vec3 away) {
  vec3 intensity = vec3(light.intensity_inner);
  float cosine = dot(vec3(light.direction_outer), away);
  if (light.position_type.w > 0.5f && light.position_type.w < 1.5f) {
    float t = clamp((cosine - light.direction_outer.w) / (light.intensity_inner.w - light.direction_outer.w),
                    0.0f, 1.0f);
    intensity = intensity * (t * t * (3.0f - 2.0f * t));
  }
  if (light.position_type.w < -0.5f) intensity = intensity * max(cosine, 0.0f);
  return intensity;
}

// Unit direction from a point to the light.
RL_FUNCTION vec3 light_direction(LightParams light, vec3 position) {
  if (light.position_type.w > 1.5f) return -vec3(light.direction_outer);
  return normalize(vec3(light.position_type) - position);
}

// Unshadowed irradiance [W/m^2] of a surface point with unit shading normal ns and geometric normal ng (both on
// the lit side). Zero from behind either normal, and at the light's own position.
RL_FUNCTION vec3 light_irradiance(LightParams light, vec3 position, vec3 ns, vec3 ng) {
  if (light.position_type.w > 1.5f) {
    vec3 towards = -vec3(light.direction_outer);
    float c = dot(ns, towards);
    if (!(c > 0.0f) || !(dot(ng, towards) > 0.0f)) return vec3(0.0f);
    return vec3(light.intensity_inner) * c;
  }
  vec3 to_light = vec3(light.position_type) - position;
  float r2 = dot(to_light, to_light);
  if (!(r2 > 0.0f)) return vec3(0.0f);
  vec3 w = to_light * (1.0f / sqrt(r2));
  float cosine = dot(ns, w);
  if (!(cosine > 0.0f) || !(dot(ng, w) > 0.0f)) return vec3(0.0f);
  return light_intensity(light, -w) * (cosine / r2);
}

#endif
