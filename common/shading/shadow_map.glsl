// Reads the maps that common/shading/shadow_maps.cpp renders.
#ifndef RELIGHT_SHADOW_MAP
#define RELIGHT_SHADOW_MAP

uniform sampler2DArray shadow_maps;
uniform int shadow_faces;
uniform vec3 shadow_axis_x, shadow_axis_y, shadow_axis_z;
uniform float shadow_tan_half;
uniform float shadow_near;
uniform int shadow_map_size;
uniform float shadow_position_error;  // rounding error of surface positions [scene units]

// Face and face coordinates (right, up, forward) of rel = point - light; order as in LightFrame::face.
vec3 shadow_face(vec3 rel, out int face) {
  vec3 l = vec3(dot(shadow_axis_x, rel), dot(shadow_axis_y, rel), dot(shadow_axis_z, rel));
  vec3 a = abs(l);
  face = 0;
  if (shadow_faces == 1) return l;
  if (a.z >= a.x && a.z >= a.y) {
    face = l.z > 0.0 ? 0 : 5;
    return vec3(l.xy, a.z);
  }
  if (a.x >= a.y) {
    face = l.x > 0.0 ? 1 : 2;
    return vec3(l.yz, a.x);
  }
  face = l.y > 0.0 ? 3 : 4;
  return vec3(l.zx, a.y);
}

// 1 if the light sees the point, else 0. ng: geometric normal on the lit side. The maps' depths are already biased by
// their slope over half a texel; here only rounding is left, which grows with the coordinates and the distance.
float shadow_map_visibility(vec3 rel, vec3 ng) {
  int face;
  vec3 offset = ng * shadow_position_error;
  vec3 p = shadow_face(rel + offset, face);
  if (!(p.z > 0.0) || face >= shadow_faces) return 1.0;  // outside the cone: no light, no shadow
  vec2 uv = p.xy / (shadow_tan_half * p.z) * 0.5 + 0.5;
  ivec2 texel = clamp(ivec2(floor(uv * float(shadow_map_size))), ivec2(0), ivec2(shadow_map_size - 1));
  float stored = texelFetch(shadow_maps, ivec3(texel, face), 0).r;  // near / depth; 0: nothing there
  return stored * p.z > shadow_near * (1.0 + 4.0 / 1048576.0) ? 0.0 : 1.0;
}

#endif
