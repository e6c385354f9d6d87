// Reads the maps that common/shading/shadow_maps.cpp renders.
#ifndef RELIGHT_SHADOW_MAP
#define RELIGHT_SHADOW_MAP

uniform sampler2DArray shadow_maps;
uniform int shadow_faces;
uniform int shadow_parallel;
uniform vec3 shadow_origin;
uniform vec3 shadow_axis_x, shadow_axis_y, shadow_axis_z;
uniform float shadow_tan_half;
uniform float shadow_near;
uniform int shadow_map_size;
const float shadow_rounding = 4.0 / 1048576.0;  // 32 ulps: of the rasteriser's interpolated depth
uniform float shadow_position_error;  // rounding error of surface positions [scene units]

// The face of the cube that v points to, in the order of LightFrame::face.
int shadow_face(vec3 v) {
  vec3 a = abs(v);
  if (shadow_faces == 1 || (a.z >= a.x && a.z >= a.y)) return shadow_faces == 1 || v.z > 0.0 ? 0 : 5;
  if (a.x >= a.y) return v.x > 0.0 ? 1 : 2;
  return v.y > 0.0 ? 3 : 4;
}

// Components of v along right, up and forward of a face.
vec3 in_face(vec3 v, int face) {
  if (face == 0) return v;
  if (face == 5) return vec3(v.xy, -v.z);
  if (face <= 2) return vec3(v.yz, face == 1 ? v.x : -v.x);
  return vec3(v.zx, face == 3 ? v.y : -v.y);
}

vec3 in_light_frame(vec3 v) {
  return vec3(dot(shadow_axis_x, v), dot(shadow_axis_y, v), dot(shadow_axis_z, v));
}

// 1 if the light sees the point, else 0. rel: point - shadow_origin; ng: geometric normal on the lit side.
// A map knows the depth at a texel's centre only, up to half a texel away in x and y. Over that distance the surface
// that is seen there rises towards the light by its own slope, which the maps' depths already allow for, and the
// point's own plane by at most the normal offset taken here. Rounding adds what grows with coordinates and distance.
float shadow_map_visibility(vec3 rel, vec3 ng) {
  vec3 l = in_light_frame(rel), n = in_light_frame(ng);
  int face = shadow_face(l);
  vec3 n_face = in_face(n, face);
  float half_texel = shadow_tan_half * (shadow_parallel != 0 ? 1.0 : in_face(l, face).z) / float(shadow_map_size);
  l += n * (half_texel * (abs(n_face.x) + abs(n_face.y)) + shadow_position_error);
  face = shadow_face(l);
  vec3 p = in_face(l, face);
  if (shadow_parallel == 0 && (!(p.z > 0.0) || face >= shadow_faces)) return 1.0;  // outside the cone: no light
  vec2 uv = p.xy / (shadow_parallel != 0 ? shadow_tan_half : shadow_tan_half * p.z) * 0.5 + 0.5;
  ivec2 texel = clamp(ivec2(floor(uv * float(shadow_map_size))), ivec2(0), ivec2(shadow_map_size - 1));
  float stored = texelFetch(shadow_maps, ivec3(texel, face), 0).r;  // near / depth; 0: nothing there
  // Linear depth: 1 in front, 0 behind the scene.
  if (shadow_parallel != 0) return stored > 0.5 - 0.5 * p.z / shadow_near + shadow_rounding ? 0.0 : 1.0;
  return stored * p.z > shadow_near * (1.0 + shadow_rounding) ? 0.0 : 1.0;
}

#endif
