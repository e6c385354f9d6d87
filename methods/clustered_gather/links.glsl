// Equation 3, outer sum: what a pixel interpolates between view clusters, times its albedo (DIFFUSE) or as it is, added to
// what is there. A texel holds two links: cluster and weight of each, or with HALF both
// clusters and then both weights.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(binding = 0) uniform usamplerBuffer links;
layout(binding = 1) uniform samplerBuffer gathered;
layout(binding = 2) uniform samplerBuffer albedo;
layout(std430, binding = 3) buffer Indirect { vec4 indirect[]; };
layout(std430, binding = 4) readonly buffer Pixel { uint pixel[]; };
uniform uint pixels;
uniform uint texels_per_pixel;

void main() {
  uint i = item_index();
  if (i >= pixels) return;
  uint p = pixel[i];
  vec3 sum = vec3(0.0f);
  int begin = int(i * texels_per_pixel), end = begin + int(texels_per_pixel);
  for (int at = begin; at < end; ++at) {
    uvec4 two = texelFetch(links, at);
#if HALF
    vec2 weights = unpackHalf2x16(two.z);
    sum += weights.x * texelFetch(gathered, int(two.x)).rgb;
    sum += weights.y * texelFetch(gathered, int(two.y)).rgb;
#else
    sum += uintBitsToFloat(two.y) * texelFetch(gathered, int(two.x)).rgb;
    sum += uintBitsToFloat(two.w) * texelFetch(gathered, int(two.z)).rgb;
#endif
  }
#if DIFFUSE
  indirect[p] = vec4(sum * texelFetch(albedo, int(p)).rgb, 0.0f);
#else
  indirect[p].rgb += sum;
#endif
}
