// Deferred direct lighting: one light, one sample an invocation (Hasan 2006 section 5). Adds to what earlier lights
// left unless `first_light`. The light model and the BRDF are the sources that the CPU compiles too.
#include "common/gpu/item_index.glsl"
#include "common/lights/light_models.glsl"
#if BEAM
#include "common/lights/beam.glsl"
layout(binding = 3) uniform samplerBuffer slide;
uniform vec4 beam_right_width, beam_up_height, beam_forward_roundness, beam_edges_shear, beam_cuts, beam_falloff_slide;
#endif
#include "common/brdf/brdf.glsl"
#if USER_LIGHT
#include "common/lights/user_light.glsl"
uniform vec3 user_parameters[8];
uniform vec3 user_right, user_up, user_forward;
#endif
#if SHADOW_MAPS
#include "common/shading/shadow_map.glsl"
#endif

layout(local_size_x = 64) in;

// Texels, because a software rasteriser reads storage blocks very slowly.
struct PackedSample {
  vec4 position_exponent;
  vec4 ns_ngx;
  vec4 ngyz_diffuse_rg;
  vec4 diffuse_b_glossy;
};
#if FORMAT == 0
// Four texels a sample, as gpu_samples.cpp packs them; an invalid sample has zero normals.
layout(binding = 1) uniform samplerBuffer samples;
PackedSample sample_of(uint i) {
  int texel = int(i) * 4;
  return PackedSample(texelFetch(samples, texel), texelFetch(samples, texel + 1), texelFetch(samples, texel + 2),
                      texelFetch(samples, texel + 3));
}
#else
#include "common/shading/sample_formats.glsl"
layout(binding = 1) uniform usamplerBuffer samples;
uniform vec4 frame;
uniform float unit;
CompactSample compact_sample(uint i) {
#if FORMAT == 1
  int at = int(i) * 5;
  return half_sample(texelFetch(samples, at).r, texelFetch(samples, at + 1).r, texelFetch(samples, at + 2).r,
                     texelFetch(samples, at + 3).r, texelFetch(samples, at + 4).r, frame, unit);
#else
  uvec3 words = texelFetch(samples, int(i)).rgb;
  return byte_sample(words.x, words.y, words.z, frame);
#endif
}
// Without a glossy part, and with one normal.
PackedSample sample_of(uint i) {
  CompactSample s = compact_sample(i);
  return PackedSample(vec4(s.position, 1.0), vec4(s.normal, s.normal.x), vec4(s.normal.yz, s.diffuse.rg),
                      vec4(s.diffuse.b, 0.0, 0.0, 0.0));
}
#endif
layout(std430, binding = 1) buffer Radiance { vec4 radiance[]; };
#if !SHADOW_MAPS
layout(std430, binding = 2) readonly buffer Visibility { uint visibility[]; };  // one bit a sample
#endif
layout(std430, binding = 3) buffer Report {
  uint non_finite_count;
  uint non_finite_first;  // smallest index
};

const BrdfShape no_shape = BrdfShape(0.0, 0.0, 0.0, 0u, 0u, 0u, 0u, 0u);
#if SHAPES
layout(binding = 2) uniform usamplerBuffer shapes;  // two texels a sample: the words of BrdfShape
BrdfShape shape_of(uint i) {
  uvec4 a = texelFetch(shapes, int(i) * 2), b = texelFetch(shapes, int(i) * 2 + 1);
  return BrdfShape(uintBitsToFloat(a.x), uintBitsToFloat(a.y), uintBitsToFloat(a.z), a.w, b.x, b.y, b.z, b.w);
}
#else
BrdfShape shape_of(uint i) { return no_shape; }  // all glossy parts are Phong
#endif

uniform uint sample_count;
uniform uint first_sample;  // index of samples[0] in its set, for reports
uniform vec3 eye;
uniform int first_light;
uniform int shadowed;
uniform vec4 light_position_type, light_direction_outer, light_intensity_inner;

float visible(uint i, vec3 position, vec3 ng) {
  if (shadowed == 0) return 1.0;
#if SHADOW_MAPS
  return shadow_map_visibility(position - shadow_origin, ng);
#else
  return float((visibility[i >> 5] >> (i & 31u)) & 1u);
#endif
}

vec3 reflected(uint i) {
  PackedSample s = sample_of(i);
  vec3 position = s.position_exponent.xyz;
  vec3 ns = s.ns_ngx.xyz;
  vec3 ng = vec3(s.ns_ngx.w, s.ngyz_diffuse_rg.xy);
  LightParams light = LightParams(light_position_type, light_direction_outer, light_intensity_inner);
  vec3 irradiance = light_irradiance(light, position, ns, ng);
  if (irradiance == vec3(0.0)) return vec3(0.0);
#if USER_LIGHT
  vec3 from_light = position - light_position_type.xyz;
  float range = length(from_light);
  vec3 away = from_light / range;
  irradiance *= user_light(vec3(dot(user_right, away), dot(user_up, away), dot(user_forward, away)), range,
                           user_parameters);
#endif
#if BEAM
  irradiance *= beam_factor(BeamParams(beam_right_width, beam_up_height, beam_forward_roundness, beam_edges_shear,
                                       beam_cuts, beam_falloff_slide),
                            slide, position - light_position_type.xyz);
#endif
  BrdfParams brdf = BrdfParams(vec3(s.ngyz_diffuse_rg.zw, s.diffuse_b_glossy.x), s.position_exponent.w,
                               s.diffuse_b_glossy.yzw, shape_of(i));
#if ALL_LOBES
  vec3 f = brdf_eval(brdf, ns, normalize(eye - position), light_direction(light, position));
#else
  vec3 f = brdf_diffuse(brdf);
#endif
  return f * irradiance * visible(i, position, ng);
}

void main() {
  uint i = item_index();
  if (i >= sample_count) return;
  vec3 value = reflected(i);
  if (any(isnan(value)) || any(isinf(value))) {
    atomicAdd(non_finite_count, 1u);
    atomicMin(non_finite_first, first_sample + i);
    value = vec3(0.0);
  }
  if (first_light == 0) value += radiance[i].rgb;
  radiance[i] = vec4(value, 0.0);
}
