// Compact forms of a diffuse surface sample, one source for C++ (GLM) and GLSL; see common/glsl_in_cpp.h for the subset.
// What makes them: sample_formats.h.
#ifndef RELIGHT_SAMPLE_FORMATS
#define RELIGHT_SAMPLE_FORMATS

struct CompactSample {
  vec3 position;  // scene units
  vec3 normal;    // unit
  vec3 diffuse;
};

// Nine 16-bit floats: position in the frame, normal, diffuse coefficient in units of the largest. Only the first half of
// e is used.
RL_FUNCTION CompactSample half_sample(uint a, uint b, uint c, uint d, uint e, vec4 frame, float unit) {
  vec2 xy = unpackHalf2x16(a), z_nx = unpackHalf2x16(b), nyz = unpackHalf2x16(c), rg = unpackHalf2x16(d),
       b_none = unpackHalf2x16(e);
  return CompactSample(vec3(frame) + frame.w * vec3(xy.x, xy.y, z_nx.x), normalize(vec3(z_nx.y, nyz.x, nyz.y)),
                       unit * vec3(rg.x, rg.y, b_none.x));
}

// Unit vector of a point of the square [-1,1]^2 (octahedral map: Cigolle et al., "A survey of efficient representations
// for independent unit vectors", JCGT 2014).
RL_FUNCTION vec3 octahedral_direction(vec2 p) {
  vec3 d = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
  if (d.z < 0.0f)
    d = vec3((1.0f - abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f), d.z);
  return normalize(d);
}

// Twelve bytes: position in the frame (16 bits each), normal (two bytes on the octahedron), diffuse coefficient (three
// bytes and an exponent that they share).
RL_FUNCTION CompactSample byte_sample(uint xy, uint z_normal, uint rgbe, vec4 frame) {
  vec3 place = vec3(float(xy & 65535u), float(xy >> 16), float(z_normal & 65535u)) * (2.0f / 65535.0f) - vec3(1.0f);
  vec2 square = vec2(float((z_normal >> 16) & 255u), float(z_normal >> 24)) * (1.0f / 127.0f) - vec2(1.0f);
  float scale = uintBitsToFloat((rgbe >> 24) << 23) * (1.0f / 256.0f);
  vec3 diffuse = vec3(float(rgbe & 255u), float((rgbe >> 8) & 255u), float((rgbe >> 16) & 255u)) * scale;
  return CompactSample(vec3(frame) + frame.w * place, octahedral_direction(square), diffuse);
}
#endif
