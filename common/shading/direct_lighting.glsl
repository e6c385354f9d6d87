// Deferred direct lighting: one light, one sample an invocation (Hasan 2006 section 5). Adds to what earlier lights
// left unless `first_light`. The light model and the BRDF are the sources that the CPU compiles too.
#include "common/gpu/item_index.glsl"
#include "common/lights/light_models.glsl"
#include "common/brdf/brdf.glsl"
#if SHADOW_MAPS
#include "common/shading/shadow_map.glsl"
#endif

layout(local_size_x = 64) in;

struct PackedSample {  // as gpu_samples.cpp packs it; an invalid sample has zero normals
  vec4 position_exponent;
  vec4 ns_ngx;
  vec4 ngyz_diffuse_rg;
  vec4 diffuse_b_glossy;
};
layout(std430, binding = 0) readonly buffer Samples { PackedSample samples[]; };
layout(std430, binding = 1) buffer Radiance { vec4 radiance[]; };
#if !SHADOW_MAPS
layout(std430, binding = 2) readonly buffer Visibility { uint visibility[]; };  // one bit a sample
#endif
layout(std430, binding = 3) buffer Report {
  uint non_finite_count;
  uint non_finite_first;  // smallest index
};
layout(std430, binding = 4) readonly buffer Shapes { BrdfShape shapes[]; };  // only where has_shapes

uniform uint sample_count;
uniform uint first_sample;  // index of samples[0] in its set, for reports
uniform vec3 eye;
uniform int all_lobes;
uniform int has_shapes;  // 0: all glossy parts are Phong
uniform int first_light;
uniform int shadowed;
uniform vec4 light_position_type, light_direction_outer, light_intensity_inner;

const BrdfShape no_shape = BrdfShape(0.0, 0.0, 0.0, 0u, 0u, 0u, 0u, 0u);

float visible(uint i, vec3 position, vec3 ng) {
  if (shadowed == 0) return 1.0;
#if SHADOW_MAPS
  return shadow_map_visibility(position - light_position_type.xyz, ng);
#else
  return float((visibility[i >> 5] >> (i & 31u)) & 1u);
#endif
}

vec3 reflected(uint i) {
  PackedSample s = samples[i];
  vec3 position = s.position_exponent.xyz;
  vec3 ns = s.ns_ngx.xyz;
  vec3 ng = vec3(s.ns_ngx.w, s.ngyz_diffuse_rg.xy);
  LightParams light = LightParams(light_position_type, light_direction_outer, light_intensity_inner);
  vec3 irradiance = light_irradiance(light, position, ns, ng);
  if (irradiance == vec3(0.0)) return vec3(0.0);
  BrdfParams brdf = BrdfParams(vec3(s.ngyz_diffuse_rg.zw, s.diffuse_b_glossy.x), s.position_exponent.w,
                               s.diffuse_b_glossy.yzw, no_shape);
  if (has_shapes != 0) brdf.shape = shapes[i];
  vec3 f = brdf_diffuse(brdf);
  if (all_lobes != 0) {
    f = brdf_eval(brdf, ns, normalize(eye - position), normalize(light_position_type.xyz - position));
  }
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
